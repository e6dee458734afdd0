"""Ground that everything stands on: the torus, errors, settings, results, memory and the cache folder."""
