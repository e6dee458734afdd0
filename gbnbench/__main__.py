"""``python -m gbnbench`` is the gbnbench command."""

from __future__ import annotations

from gbnbench.cli import main

if __name__ == "__main__":
    main()
