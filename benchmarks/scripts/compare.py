#!/usr/bin/env python3
"""Two states of the same particles, tables x y z r vx vy vz: compare.py A B LX LY LZ (0: not periodic)."""
import sys, numpy as np
a, b = np.loadtxt(sys.argv[1]), np.loadtxt(sys.argv[2]); per = list(map(float, sys.argv[3:6]))
d = b[:, :3] - a[:, :3]
for k in range(3):
    if per[k] > 0: d[:, k] -= per[k] * np.round(d[:, k] / per[k])
n = np.sqrt((d**2).sum(1)); v = b[:, 4:7] - a[:, 4:7]
m = 4 / 3 * np.pi * 2500 * a[:, 3]**3
ke = lambda t: 0.5 * (m * (t[:, 4:7]**2).sum(1)).sum()
print(sys.argv[1], sys.argv[2], "position difference [m]: median %.3g rms %.3g max %.3g; velocity rms difference %.3g of rms %.3g m/s; kinetic energies %.6e %.6e J (%+.3f %%)" % (np.median(n), np.sqrt((n**2).mean()), n.max(), np.sqrt((v**2).sum(1).mean()), np.sqrt((a[:, 4:7]**2).sum(1).mean()), ke(a), ke(b), 100 * (ke(b) / ke(a) - 1)))
