"""Random input of every kind: what is drawn, and how long it is tried."""
