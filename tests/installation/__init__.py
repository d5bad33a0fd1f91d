"""The wheel in empty environments, as somebody would install it."""
