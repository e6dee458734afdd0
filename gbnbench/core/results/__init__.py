"""Results of the analysis, frozen, each with the settings that made it."""
