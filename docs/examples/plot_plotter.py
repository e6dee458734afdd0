"""
A picture for a pen plotter
===========================

This example draws dots whose density follows the darkness of an image, orders them so that the pen's path
is short, and writes them as an SVG in millimetres.
"""

# %%
# ``stipple`` takes a file, an array or the name of one of scikit-image's pictures. With ``invert`` the dots
# follow the light in place of the darkness: a white pen on black paper.

import shlex
import subprocess
import sys
import tempfile

import matplotlib.pyplot as plt

import gbnbench

made = gbnbench.stipple("coins", 3000, invert=True, seed=1)
print(made)

# %%
# The command writes the page that a plotter takes, in millimetres and in a good order: in a terminal
# ``gbnbench stipple coins -n 3000 --invert --order tour -o coins.svg``.

folder = tempfile.mkdtemp()
words = shlex.split("stipple coins -n 3000 --invert --seed 1 --order tour -o coins.svg --quiet")
written = subprocess.run(
    [sys.executable, "-m", "gbnbench", *words], cwd=folder, capture_output=True, text=True, check=True
)
print(written.stdout or written.stderr)

# %%
# The picture that is reconstructed from the points alone, by the paper's Algorithm 2, shows how much of the
# original they preserve.

back = gbnbench.reconstruct(made.points, shape=made.size[::-1])
figure, (dots, image) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
dots.plot(*made.points.T, "w.", markersize=1.5)
dots.set(
    aspect=made.size[1] / made.size[0], xlim=(0, 1), ylim=(0, 1), xticks=[], yticks=[], title="3,000 dots",
    facecolor="black",
)  # fmt: skip
image.imshow(back, cmap="gray_r")  # it takes dots for black ink; these are white
image.set(xticks=[], yticks=[], title="found back from the dots")
