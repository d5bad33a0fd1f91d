"""A clock that jumps by hours whenever it is read, for whole processes and all that they start."""
