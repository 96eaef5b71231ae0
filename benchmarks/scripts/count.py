#!/usr/bin/env python3
"""Instructions of a step, which do not depend on who else uses the machine. Valgrind has no AVX-512, so this is the AVX2
build of the loops.

  valgrind --tool=callgrind --callgrind-out-file=OUT15 pulvis-bench bed --table bed32k.txt --steps 15
  valgrind --tool=callgrind --callgrind-out-file=OUT5 pulvis-bench bed --table bed32k.txt --steps 5
  count.py OUT15 OUT5 10 CONTACTS PARTICLES

The difference of two runs leaves out setting up and reporting. Works for LAMMPS and LIGGGHTS as well."""
import collections, re, sys

longer, shorter = sys.argv[1:3]
steps, contacts, particles = map(int, sys.argv[3:6])

def read(path):
    """Own instructions by function."""
    cost, names, function, called = collections.Counter(), {}, "", False
    for line in open(path):
        if line.startswith("fn="):
            number, name = re.fullmatch(r"fn=(\(\d+\))\s*(.*)", line.rstrip("\n")).groups()
            function = names.setdefault(number, name)
        elif line.startswith("cfn="):
            number, name = re.fullmatch(r"cfn=(\(\d+\))\s*(.*)", line.rstrip("\n")).groups()
            if name:
                names.setdefault(number, name)
        elif line.startswith("calls="):
            called = True  # the next line is the cost of what was called: counted there
        elif line[:1].isdigit() or line[:1] in "+-*":
            if not called:
                cost[function] += int(line.split()[-1])
            called = False
    return cost

cost = read(longer)
cost.subtract(read(shorter))
total = sum(cost.values()) / steps
print("per step %.3f M, per particle-step %.0f, per contact-step %.0f" % (total / 1e6, total / particles, total / contacts))
for function, count in cost.most_common(10):
    print("%8.1f per contact-step  %s" % (count / steps / contacts, function[:100]))
