"""A layer bonded to a rigid base, as ContactMechanics has it, beside DIRECTORY/layered_waves.csv of `layered_waves`.

    python layer_peers.py DIRECTORY

prints a table, a line for each Poisson's ratio and thickness: the largest relative difference of the displacement by
waves of pressure, and that by the mean pressure. The formula of ContactMechanics subtracts nearly equal numbers where
waves are long beside the thickness: the last two columns are the errors of both codes for waves, from the same formula
in 60 digits.
"""
import csv
import decimal
import itertools
import os
import sys
from decimal import Decimal

import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace

# Cells along a side: the waves of fuge go up to 32.
CELLS = 66
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803")


def exact(poisson, thickness, i, j):
    """Displacement per pressure with i and j waves in a period of 1, E = 1; bonded to a rigid base."""
    nu, h = Decimal(poisson), Decimal(thickness)
    q = 2*PI*Decimal(i*i + j*j).sqrt()
    t = q*h
    up, down = (2*t).exp(), (-2*t).exp()
    twice = (3 - 4*nu)*(up - down) - 4*t, (3 - 4*nu)*(up + down) + 4*t**2 + 2*(5 - 12*nu + 8*nu**2)
    return float(2*(1 - nu**2)/q*twice[0]/twice[1])


def main():
    decimal.getcontext().prec = 60
    with open(os.path.join(sys.argv[1], "layered_waves.csv")) as table:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(table)]
    print("| Poisson's ratio | thickness over period | waves | mean pressure | waves, error of fuge "
          "| waves, error of ContactMechanics |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: |")
    for (poisson, thickness), group in itertools.groupby(rows, lambda row: (row["poisson"], row["thickness"])):
        body = PeriodicFFTElasticHalfSpace((CELLS, CELLS), 1.0, (1.0, 1.0), thickness=thickness, poisson=poisson)
        peer = np.asarray(body.greens_function).real
        mean, *waves = group
        differences, errors, peer_errors = [], [], []
        for row in waves:
            i, j = int(row["i"]), int(row["j"])
            truth = exact(poisson, thickness, i, j)
            differences.append(row["compliance"]/peer[i, j] - 1)
            errors.append(row["compliance"]/truth - 1)
            peer_errors.append(peer[i, j]/truth - 1)
        worst = [np.abs(values).max() for values in (differences, errors, peer_errors)]
        worst.insert(1, abs(mean["compliance"] - peer[0, 0])/peer[0, 0])
        figures = " | ".join(f"{value:.0e}" if value else "0" for value in worst)
        print(f"| {poisson:g} | {thickness:g} | {figures} |")


main()
