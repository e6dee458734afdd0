"""Point sets moved, as little as possible, to given amplitudes of their spectrum below an edge."""
