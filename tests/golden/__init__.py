"""Results that stay what they are: their recipe, and the numbers it gave."""
