"""Pictures of studies of integration."""
