"""The noise-floor regression: cases kept in a file, measured again and judged, and the file remade."""
