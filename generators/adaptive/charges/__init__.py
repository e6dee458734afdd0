"""Points as charges that repel one another and are attracted by the ink."""
