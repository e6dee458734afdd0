"""Entry point of ``python -m gbnbench.benchmarks.claims``."""

from gbnbench.benchmarks.claims.run import main

main()
