"""Libraries of ready point sets: which are to be made, at what cost, and how they are made."""
