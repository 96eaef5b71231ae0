"""100 000 collisions: where the Luding law sticks, over adhesion and speed; and what a collision costs by each method."""

from __future__ import annotations

import time

import numpy as np

import pulvis

luding = pulvis.law("luding", k1=100, kp=500, kc=np.linspace(0, 300, 250), phi_f=0.05)
speed = np.geomspace(0.02, 20, 400)[:, None]
bodies = {"radius": 1.1e-3, "density": 2000.0}

began, busy = time.perf_counter(), time.process_time()
hits = pulvis.collide(luding, **bodies, velocity=speed, method="engine")
seconds, busy = time.perf_counter() - began, time.process_time() - busy
print(f"{hits.restitution.size} collisions by the engine's method: {seconds:.1f} s, {busy:.1f} s of processors")
print(f"share that sticks: {np.mean(hits.regime == 'stick'):.3f}")

few = np.geomspace(0.02, 20, 1000)
began = time.perf_counter()
exact = pulvis.collide(luding.replace(kc=100.0), **bodies, velocity=few)
print(f"{few.size} exact collisions: {time.perf_counter() - began:.1f} s")
engine = pulvis.collide(luding.replace(kc=100.0), **bodies, velocity=few, method="engine")
print(f"largest error of the exact method:    {np.abs(exact.restitution - exact.restitution_theory).max():.1e}")
print(f"largest error of the engine's method: {np.abs(engine.restitution - exact.restitution).max():.1e}")
