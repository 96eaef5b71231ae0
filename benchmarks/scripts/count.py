#!/usr/bin/env python3
"""Instructions of Simulation::step: by function, and within the pair sweep by line. Valgrind has no AVX-512, so this is
the AVX2 build of the loop.

  valgrind --tool=callgrind --dump-instr=yes --compress-pos=no --compress-strings=no \\
      --toggle-collect='*Simulation::step*' --callgrind-out-file=OUT pulvis-bench bed --table bed32k.txt --steps 15
  count.py pulvis-bench OUT STEPS CONTACTS PARTICLES

A line is where the outermost frame of kernel.rs stands: what is inlined below counts there. LAMMPS and LIGGGHTS: the
difference of the totals of two runs over the difference of their steps."""
import collections, re, subprocess, sys

binary, out, steps, contacts, particles = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:6])
cost, function, called = collections.Counter(), "", False
for line in open(out):
    if line.startswith("fn="):
        function = line[3:].strip()
    elif line.startswith("calls="):
        called = True  # the next line is the cost of what was called: counted there
    elif line.startswith("0x"):
        if not called:
            fields = line.split()
            cost[function, int(fields[0], 16)] += int(fields[-1])
        called = False

total = sum(cost.values()) / steps
print("per step %.3f M, per particle-step %.0f, per contact-step %.0f" % (total / 1e6, total / particles, total / contacts))
functions = collections.Counter()
for (function, _), count in cost.items():
    functions[re.sub(r"_avx512\w*version", "", function)] += count
for function, count in functions.most_common(8):
    print("%8.1f per contact-step  %s" % (count / steps / contacts, function[-80:]))

sweep = {address: count for (function, address), count in cost.items() if "sweep_pairs" in function}
frames, address = collections.defaultdict(list), None
command = ["addr2line", "-a", "-i", "-e", binary]
for line in subprocess.run(command, input="\n".join(map(hex, sweep)), capture_output=True, text=True).stdout.splitlines():
    if re.fullmatch(r"0x[0-9a-f]+", line):
        address = int(line, 16)
    else:
        frames[address].append(line)
lines = collections.Counter()
for address, count in sweep.items():
    kernel = [frame for frame in frames[address] if "kernel.rs" in frame] or frames[address][-1:]
    lines[re.sub(r".*/", "", kernel[-1]).split(" ")[0]] += count
for line, count in lines.most_common(30):
    print("%8.1f %s" % (count / steps / contacts, line))
