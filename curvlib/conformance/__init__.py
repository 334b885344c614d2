"""What every estimator keeps, checked on any file: the project's own and a stranger's."""
