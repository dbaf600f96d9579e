(Li et al. 2025: a lap around a rectangle with corners of R5, nodes A to K)
G21 G90 G17 G64
G0 X-205 Y-210 Z0
(run-in at the speed in A)
G1 Y-200 F130
(A to B)
Y-177.08 F190
(B to C, then the corners C D, E F, G H and I J)
Y200 F1260
G2 X-200 Y205 R5
G1 X200
G2 X205 Y200 R5
G1 Y-200
G2 X200 Y-205 R5
G1 X-200
G2 X-205 Y-200 R5
(J to K, and run-out at the speed in K)
G1 Y-177.08
Y-170 F130
M2
