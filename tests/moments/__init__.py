"""Commands that are stopped at random moments, and what has to hold then."""
