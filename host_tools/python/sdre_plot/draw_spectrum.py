# SPDX-License-Identifier: MIT
"""Draws the speed spectra of a run, one panel per measure: `sdre-sil run --spectrum`.

Usage: draw_spectrum.py SPECTRUM.csv TITLE OUT.png|OUT.svg
"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "sdre"  # same spectrum, same bytes
import matplotlib.pyplot as plt  # noqa: E402

MOST_Hz = 1000.0  # chosen: paper B's disturbances and their overtones; nothing is seen above


def read(path):
    """{measure: (frequencies, amplitudes)}, in the order of the file."""
    spectra = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if float(row["frequency_Hz"]) <= MOST_Hz:
                lines = spectra.setdefault(row["measure"], ([], []))
                lines[0].append(float(row["frequency_Hz"]))
                lines[1].append(float(row["amplitude_rpm"]))
    return spectra


def main(spectrum_path, title, out_path):
    spectra = read(spectrum_path)
    figure, axes = plt.subplots(
        max(1, len(spectra)),
        1,
        figsize=(8, 1 + 2.5 * max(1, len(spectra))),
        sharex=True,
        squeeze=False,
        constrained_layout=True,
    )
    figure.suptitle(title)
    for axis, (measure, (frequencies, amplitudes)) in zip(axes[:, 0], spectra.items()):
        axis.vlines(frequencies, 0.0, amplitudes, lw=1.5)
        axis.set_ylim(bottom=0.0)
        axis.set_title(measure, fontsize="medium")
        axis.set_ylabel("amplitude [r/min]")
        axis.grid(alpha=0.3)
    axes[-1, 0].set_xlabel("frequency [Hz]")
    metadata = {"Date": None} if out_path.endswith(".svg") else None
    figure.savefig(out_path, dpi=110, metadata=metadata)


if __name__ == "__main__":
    main(*sys.argv[1:])
