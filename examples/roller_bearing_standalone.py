"""A rotor on one roller bearing: the clearance makes every passing roller audible.

The stand-alone case of Mohammadpour et al. (2015), Table A2: 50 kg and 1500 N on a bearing with
12 rollers at 209 rad/s. With 10 um interference all rollers carry load and the shaft stands
still; with 10 um clearance two or three of them carry it and the shaft moves as they pass.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import gearlube as gl

FIT = 10e-6  # m, Table A2
DURATION = 1.5  # s
PASSES = 80  # roller passes at the end that enter the spectrum: whole periods, so no window
SAMPLES = 32  # per roller pass


def run(fit: float) -> tuple[gl.bearing.RotorOnBearing, Any]:
    """Return the rotor with the given interference (negative: clearance) and its motion."""
    rotor = gl.bearing.RotorOnBearing.mohammadpour_2015(fit)
    start = 0.0 if fit > 0.0 else 1.5 * abs(fit)
    return rotor, rotor.simulate(DURATION, samples_per_pass=SAMPLES, displacement=(start, 0.0))


def spectrum(history: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return frequencies [Hz] and amplitudes [m] of the motion along the load."""
    x = history.displacement[-PASSES * SAMPLES :, 0]
    step = history.time[1] - history.time[0]
    return np.fft.rfftfreq(x.size, step), 2.0 / x.size * np.abs(np.fft.rfft(x - x.mean()))


def strongest_line(fit: float) -> tuple[float, float]:
    """Return the frequency [Hz] and amplitude [m] of the strongest line of the motion."""
    frequency, amplitude = spectrum(run(fit)[1])
    k = int(np.argmax(amplitude))
    return float(frequency[k]), float(amplitude[k])


if __name__ == "__main__":
    import matplotlib.pyplot as plt

    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(7, 9), layout="constrained")
    for fit, name in ((FIT, "10 um interference"), (-FIT, "10 um clearance")):
        rotor, history = run(fit)
        last = history.time > DURATION - 0.1
        time_ms = 1e3 * (history.time[last] - DURATION)
        top.plot(time_ms, 1e6 * history.displacement[last, 0], label=name)
        middle.plot(time_ms, history.roller_load[last, 0], label=name)
        frequency, amplitude = spectrum(history)
        bottom.semilogy(frequency, 1e6 * np.maximum(amplitude, 1e-13), label=name)
    top.set(xlabel="time [ms]", ylabel="displacement [um]")
    middle.set(xlabel="time [ms]", ylabel="load of one roller [N]")
    bottom.set(xlabel="frequency [Hz]", ylabel="displacement [um]", xlim=(0, 1500))
    for order in range(1, 10):
        bottom.axvline(order * rotor.roller_pass_frequency, color="0.8", zorder=0)
    top.legend()
    plt.show()
