"""Executors, one a module: processes here, a Dask scheduler's workers, ranks of MPI, jobs of Slurm."""
