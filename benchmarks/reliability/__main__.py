"""Entry point of ``python -m gbnbench.benchmarks.reliability``."""

from gbnbench.benchmarks.reliability.run import main

if __name__ == "__main__":  # a worker process imports this module as well
    main()
