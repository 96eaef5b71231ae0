#!/usr/bin/env python3
"""Times pulvis-bench and the packages lammps and liggghts on the same workloads, in turn, with one thread and rank and with two.
usage: time_turns.py PASSES OUT.csv [WORKLOAD-PREFIX]; from the folder with the tables and data files."""
import os, re, subprocess, sys, time, csv, statistics
os.environ["OMP_NUM_THREADS"] = "1"
OWN = os.environ.get("PULVIS_BENCH", "./pulvis-bench")
def bed(data): return " -log none -var gz 9.81 -var gamma 4000 -var bz f -var skin 0.1e-3 -var data " + data
gas = " -log none -var gz 0.0 -var gamma 800 -var bz p -var skin 0.2e-3 -var data gas100k.data"
LMP = "lmp -in lammps_bench.in -var pair old -var n %d"
LIG = "liggghts -in liggghts.in -var tan history -var model %d -var wall %d -var n %d"
RANKS = "mpirun --allow-run-as-root --bind-to core -np 2 "
J = []
for n, threads in (("", 1), (" x2", 2)):
    own = OWN + " %s --threads " + str(threads)
    ranks = RANKS if threads == 2 else ""
    J += [
        ("bed32k" + n, "lammps", ranks + LMP % 400 + bed("bed32k.data")),
        ("bed32k" + n, "pulvis", own % "bed --table bed32k.txt --steps 400 --law linear"),
        ("bed32k" + n, "pulvis, no ledger", own % "bed --table bed32k.txt --steps 400 --law linear --ledger off"),
        ("hysteretic32k" + n, "liggghts", ranks + LIG % (2, 2, 250) + bed("bed32k.data")),
        ("hysteretic32k" + n, "pulvis luding", own % "bed --table bed32k.txt --steps 250 --law luding"),
        ("hysteretic32k" + n, "pulvis luding, no ledger", own % "bed --table bed32k.txt --steps 250 --law luding --ledger off"),
        ("hysteretic32k" + n, "pulvis luding-full", own % "bed --table bed32k.txt --steps 250 --law luding-full"),
        ("hysteretic32k" + n, "pulvis luding-full, no ledger", own % "bed --table bed32k.txt --steps 250 --law luding-full --ledger off"),
        ("gas100k" + n, "lammps", ranks + LMP % 500 + gas),
        ("gas100k" + n, "pulvis", own % "gas --table gas100k.txt --steps 500"),
        ("bed256k" + n, "lammps", ranks + LMP % 60 + bed("bed256k.data")),
        ("bed256k" + n, "pulvis", own % "bed --table bed256k.txt --steps 60 --law linear"),
        ("bed256k" + n, "pulvis, no ledger", own % "bed --table bed256k.txt --steps 60 --law linear --ledger off"),
        ("tablet" + n, "216", own % "tablet --particles 216 --steps 40000"),
        ("tablet" + n, "1728", own % "tablet --particles 1728 --steps 8000"),
    ]
only = sys.argv[3] if len(sys.argv) > 3 else ""
J = [j for j in J if j[0].startswith(only)]
HZ = os.sysconf("SC_CLK_TCK")
def busy():
    f = list(map(int, open("/proc/stat").readline().split()[1:])); return (sum(f) - f[3] - f[4]) / HZ
rows = []
out = csv.writer(open(sys.argv[2], "w"))
out.writerow(["pass", "workload", "code", "particles", "steps", "loop_wall_s", "process_wall_s", "process_cpu_s", "others_cpu", "msteps_per_s_wall", "msteps_per_cpu_s"])
for p in range(int(sys.argv[1])):
    for w, n, c in J:
        s, t = busy(), time.time()
        q = subprocess.Popen(c.split(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT); o = q.stdout.read().decode(errors="replace")
        _, _, ru = os.wait4(q.pid, 0); pw = time.time() - t; cpu = ru.ru_utime + ru.ru_stime
        a = re.search(r"Loop time of ([\d.e-]+) on \d procs for (\d+) steps with (\d+) atoms", o); b = re.search(r"N (\d+) steps (\d+) wall ([\d.]+)", o)
        if a: lw, k, N = float(a[1]), int(a[2]), int(a[3])
        elif b: N, k, lw = int(b[1]), int(b[2]), float(b[3])
        else: print(w, n, "failed", o[-300:]); continue
        e = re.search(r"wall [\d.]+ cpu ([\d.]+)", o)
        u = re.search(r"([\d.]+)% CPU use", o)
        loop_cpu = float(e[1]) if e else lw * float(u[1]) / 100 if u else None
        m = N * k / lw / 1e6
        # CPU time of the loop where the code prints it (Pulvis, LAMMPS), else its share of the whole process as in
        # time_peers.py, which flatters codes that wait while they start
        percpu = N * k / loop_cpu / 1e6 if loop_cpu else m * pw / cpu
        rows.append((p, w, n, m, percpu))
        out.writerow([p, w, n, N, k, "%.4f" % lw, "%.3f" % pw, "%.3f" % cpu, "%.2f" % ((busy() - s - cpu) / pw), "%.4f" % m, "%.4f" % percpu])
        print("%-17s %-30s %.3f wall %.3f per CPU-s others %.2f" % (w, n, m, percpu, (busy() - s - cpu) / pw), flush=True)
print()
ref = {}
for w, n, _ in J: ref.setdefault(w, n)
for w, n, _ in J:
    v = {r[0]: r for r in rows if r[1] == w and r[2] == n}; q = {r[0]: r for r in rows if r[1] == w and r[2] == ref[w]}
    x = [i for i in v if i in q]
    if x: print("%-17s %-30s median %.2f wall %.2f per CPU-s ; median ratio to %s: %.2f wall %.2f per CPU-s" % (w, n, statistics.median(v[i][3] for i in x), statistics.median(v[i][4] for i in x), ref[w], statistics.median(v[i][3] / q[i][3] for i in x), statistics.median(v[i][4] / q[i][4] for i in x)))
