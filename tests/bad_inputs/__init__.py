"""The table of bad inputs, and the page of the documentation that is printed from it."""
