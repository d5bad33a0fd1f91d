"""What the paper prints (Yu, Li and Li, ISARC 2014), to stand beside what is computed here."""

TABLE_2 = {"c0": 0.354, "k0": 3.572, "alpha": 4.579, "beta": 0.302, "F0": 0.001}
"""0 A, 1 Hz, 2 mm. Units are implied: N s/mm, N/mm, N, 1/mm, N."""
RELATIVE_ERROR = 0.06
"""Bound of Figure 5 in the text."""
POPULATIONS = (30, 40, 50, 60, 70)
TABLE_3_FITNESS = (9.754, 6.551, 3.842, 3.426, 3.360)
TABLE_3_SECONDS = (156.457, 192.214, 239.571, 275.786, 323.143)
EXPONENTS = (2, 5, 8, 10)
"""p of the curves in Figure 2."""
ITERATIONS = 300
