"""What Python costs: import, advance(1), callbacks, forces, views, memory, Ctrl-C. `python examples/measure.py [PARTICLES]`

The numbers of the book's chapter "From Python" are from this script.
"""

from __future__ import annotations

import _thread
import resource
import subprocess
import sys
import threading
import time
from collections.abc import Callable

import numpy as np

import pulvis


def gas(edge: int) -> pulvis.Simulation:
    """A gas without contacts, as cheap to step as a system can be."""
    return pulvis.Simulation(
        materials={"glass": {"density": 2500}},
        contacts={"glass-glass": {"normal": {"law": "linear", "k": 1000}}},
        particles={
            "material": "glass",
            "radius": {"distribution": "fixed", "value": 0.5e-3},
            "arrangement": {"kind": "lattice", "lower": [0, 0, 0], "counts": [edge] * 3, "spacing": 2e-3},
        },
    )


def per_call(work: Callable[[], object], calls: int) -> float:
    """Seconds a call, the least of seven times."""
    times = []
    for _ in range(7):
        begin = time.perf_counter()
        for _ in range(calls):
            work()
        times.append((time.perf_counter() - begin) / calls)
    return min(times)


def resident() -> float:
    """The most memory that this process has had [byte]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def stopped_after(work: Callable[[], object]) -> float:
    """Seconds from Ctrl-C to its end, the most of five times."""
    waits = []
    for _ in range(5):
        asked = []

        def interrupt() -> None:
            time.sleep(0.4)
            asked.append(time.perf_counter())
            _thread.interrupt_main()

        threading.Thread(target=interrupt).start()
        try:
            work()
        except KeyboardInterrupt:
            waits.append(time.perf_counter() - asked[0])
    return max(waits)


def main() -> None:
    code = "import time, numpy; begin = time.perf_counter(); import pulvis; print(time.perf_counter() - begin)"
    runs = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(5)]
    print(f"import pulvis beside numpy: {1e3 * min(runs):.0f} ms")

    pair = gas(1)
    step = per_call(lambda: pair.advance(1000), 20) / 1000
    alone = per_call(lambda: pair.advance(1), 20_000)
    single = per_call(lambda: pair._session.advance(1, False), 20_000)
    print(f"one particle: a step {1e6 * step:.2f} us; advance(1) {1e6 * alone:.2f} us, of that the compiled part {1e6 * single:.2f} us")
    pair.every(1, lambda simulation: None)
    called = per_call(lambda: pair.advance(1000), 20) / 1000
    print(f"a callback in every step: {1e6 * (called - step):.2f} us a step more")
    pushed = gas(1)
    pushed.apply(lambda simulation: [[0.0, 0.0, 1e-6]])
    print(f"forces of a function in every step: {1e6 * (per_call(lambda: pushed.advance(1000), 5) / 1000 - step):.2f} us a step more")

    luding = pulvis.law("luding", k1=100, kp=500, kc=100, phi_f=0.05)
    speeds = np.geomspace(0.02, 20, 2_000_000)
    bed = gas(40)
    print(
        f"Ctrl-C ends a bed of {len(bed.particles)} particles within {1e3 * stopped_after(lambda: bed.advance(10**9)):.0f} ms, "
        f"a sweep within {1e3 * stopped_after(lambda: pulvis.collide(luding, radius=1e-3, density=2e3, velocity=speeds)):.0f} ms"
    )
    del bed

    edge = round(float(sys.argv[1] if len(sys.argv) > 1 else 1e6) ** (1 / 3))
    before = resident()
    many = gas(edge)
    many.advance(1)
    built = resident()
    views = [many.particles.view(name) for name in ("position", "velocity", "angular_velocity", "force", "torque")]
    total = sum(float(np.abs(view).max(initial=0.0)) for view in [views[0][:1], views[1][:1]])
    count = len(many.particles)
    print(
        f"{count} particles: {(built - before) / count:.0f} byte each at the most while they are made, "
        f"{many._session.memory_size / count:.0f} of them kept; five views {(resident() - built) / count:.1f} byte each"
    )
    del views, total
    whole = many.particles.position
    print(f"a copy of all positions by id: {whole.nbytes / count:.0f} byte each")


if __name__ == "__main__":
    main()
