"""What the workflow needs: config, readings, digests, jobs, the article."""
