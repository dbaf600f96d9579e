#!/usr/bin/env python3
"""A small part that is quickly simulated and repaired: six passes over a wave, the fourth of which has fifty points in a
millimetre. As a program, it prints the part."""

import math


def crowded_part():
    lines = ["G21 G90 G17", "G64 P0.005", "G0 X0 Y0 Z10", "G1 Z0 F1000", "G1 F3000"]
    for k in range(6):
        w = 0.0
        while w < 9.01:
            x = 9 - w if k % 2 else w
            lines.append(f"X{x:.3f} Y{0.4 * k:.3f} Z{0.5 * math.sin(0.8 * x):.3f}")
            w += 0.02 if k == 3 and 3 < w < 4 else 0.25
    return "\n".join([*lines, "G0 Z10", "M2", ""])


if __name__ == "__main__":
    print(crowded_part(), end="")
