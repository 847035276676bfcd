"""Points of an element, s = -1 at its first node and 1 at its second one, and weights of quadrature over it."""

from math import sqrt

import numpy as np

GAUSS = (-1 / sqrt(3), 1 / sqrt(3))  # both of weight 1/2: exact up to degree 3
SIMPSON = ((-1.0, 1 / 6), (0.0, 2 / 3), (1.0, 1 / 6))  # exact up to degree 3, with points at the nodes
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact up to degree 7; the weights add up to 2
