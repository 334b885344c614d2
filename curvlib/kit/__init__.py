"""What an estimator is written with: arrays in, arrays out; no mesh, no file. Published."""
