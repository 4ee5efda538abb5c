# SPDX-License-Identifier: GPL-3.0-or-later
"""The plots of a comparison, drawn from the files that `ga_symmetry compare` wrote. Needs matplotlib."""
import colorsys
import io
import json
import os
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from tables import read_csv

plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False,
                     "axes.spines.right": False, "legend.frameon": False})
# One colour and mark a method wherever it appears; -auto is the same with a dashed line and a hollow mark.
COLORS = {"naive": "#7f7f7f", "kdtree": "#000000", "pairs-squared": "#e377c2", "pairs-linear": "#9467bd",
          "features": "#8c564b", "spectral": "#ff7f0e", "zoomout": "#2ca02c", "zoomout-full": "#17becf",
          "reversing-zoomout": "#bcbd22",
          "joint": "#d62728", "joint-zoomout": "#1f77b4"}
MARKS = {"naive": "s", "kdtree": "x", "pairs-squared": "v", "pairs-linear": "^", "features": "P", "spectral": "D",
         "zoomout": "h", "zoomout-full": "H", "reversing-zoomout": "p", "joint": "o", "joint-zoomout": "*"}


def split_name(method):
    automatic = method.endswith("-auto")
    return (method[:-5] if automatic else method), automatic


def save(plots, name, figure, dpi=110):
    """Adds the figure to `plots` as the bytes of a PNG file."""
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=dpi, bbox_inches="tight", facecolor="white")
    plt.close(figure)
    plots[name] = file.getvalue()


def plot_accuracy(folder, plots):
    data = read_csv(folder, "methods.csv")
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.8))
    for axis, column, label in ((axes[0], "mean", "mean error (less is better)"), (axes[1], "corr", "corr (more is better)")):
        for row in data:
            name, automatic = split_name(row["method"])
            color = COLORS.get(name, "#444444")
            axis.plot(float(row["seconds"]), float(row[column]), MARKS.get(name, "o"), color=color, markersize=9,
                      markerfacecolor="none" if automatic else color, markeredgewidth=1.6, linestyle="none",
                      label=row["method"])
        axis.set_xscale("log")
        axis.set_xlabel("seconds a mesh, median")
        axis.set_ylabel(label)
        axis.set_ylim(bottom=0)
    axes[1].set_ylim(0, 1.03)
    axes[1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    figure.tight_layout()
    save(plots, "accuracy", figure)


def plot_error_curves(folder, plots):
    curves = defaultdict(list)
    for row in read_csv(folder, "error_curves.csv"):
        curves[row["method"]].append((float(row["error"]), float(row["share"])))
    figure, axis = plt.subplots(figsize=(9.5, 4.8))
    for method, points in curves.items():
        name, automatic = split_name(method)
        x, y = zip(*points)
        axis.plot(x, y, color=COLORS.get(name, "#444444"), linestyle="--" if automatic else "-",
                  linewidth=2.4 if name == "joint" else 1.5, label=method)
    axis.axvline(0.1262, color="#888888", linewidth=1, linestyle=":")
    axis.text(0.1275, 0.02, "0.126: corr", color="#666666", fontsize=9)
    axis.set_xlim(0, 0.3)
    axis.set_ylim(0, 1.02)
    axis.set_xlabel("error, over sqrt(area)")
    axis.set_ylabel("share of vertices at or below")
    axis.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    save(plots, "error_curves", figure)


def quartiles(series):
    """Median and quartiles over runs, generation by generation; a run that has ended keeps its last value."""
    length = max(len(s) for s in series)
    table = np.array([np.pad(s, (0, length - len(s)), mode="edge") for s in series])
    return np.percentile(table, [25, 50, 75], axis=0)


def plot_generations(folder, plots):
    fitness, diversity, joint = defaultdict(list), defaultdict(list), defaultdict(list)
    runs = defaultdict(list)
    for row in read_csv(folder, "generations.csv"):
        runs[row["mesh"], row["search"], row["regions"], row["z"], row["seed"]].append(row)
    for (_, search, regions, z, _), log in runs.items():
        best = np.array([float(r["best"]) for r in log])
        spread = np.array([float(r["diversity"]) for r in log])
        if z:
            fitness[search, float(z), int(regions)].append(best / float(log[0]["optimum"]))
            diversity[search, float(z), int(regions)].append(spread)
        elif len(log) > 1:
            joint[search].append((best / best[-1], spread))
    zs = sorted({key[1] for key in fitness})
    shades = {5: "#1f77b4", 8: "#d62728"}
    for data, name, label in ((fitness, "generations", "best fitness / optimum"),
                              (diversity, "diversity", "share of distinct individuals")):
        if not data:
            continue
        figure, axes = plt.subplots(2, len(zs), figsize=(12, 6.4), sharex=True, sharey="row", squeeze=False)
        for i, search in enumerate(("squared", "linear")):
            for k, z in enumerate(zs):
                axis = axes[i][k]
                for (s, key_z, regions), series in sorted(data.items()):
                    if (s, key_z) != (search, z):
                        continue
                    low, middle, high = quartiles(series)
                    color = shades.get(regions, "#444444")
                    axis.fill_between(range(len(middle)), low, high, color=color, alpha=0.18, linewidth=0)
                    axis.plot(middle, color=color, label=f"{regions} regions")
                axis.set_title(f"{search} error, z = {z:g}", fontsize=10)
                if name == "generations":
                    axis.set_yscale("log")
                    axis.axhline(1, color="#444444", linewidth=1, linestyle=":")
                if i == 1:
                    axis.set_xlabel("generation")
                if k == 0:
                    axis.set_ylabel(label)
        axes[0][-1].legend(loc="upper right")
        figure.suptitle("Lines: medians over meshes and seeds; bands: quartiles", fontsize=10, color="#555555")
        figure.tight_layout()
        save(plots, name, figure)
    if joint:
        figure, axes = plt.subplots(1, 2, figsize=(12, 3.8))
        for search, series in sorted(joint.items()):
            style = {"color": COLORS["joint"], "linestyle": "--" if split_name(search)[1] else "-", "label": search}
            for axis, column in ((axes[0], 0), (axes[1], 1)):
                low, middle, high = quartiles([s[column] for s in series])
                axis.fill_between(range(len(middle)), low, high, color=COLORS["joint"], alpha=0.12, linewidth=0)
                axis.plot(middle, **style)
                axis.set_xlabel("generation")
        axes[0].set_ylabel("cost / last cost")
        axes[1].set_ylabel("share of distinct maps")
        axes[1].legend()
        figure.tight_layout()
        save(plots, "joint", figure)


class View:
    """A mesh that stands, seen from its broader side, turned a little, without perspective."""

    def __init__(self, picture):
        points = np.array(picture["position"], dtype=float).reshape(-1, 3)
        self.triangle = np.array(picture["triangle"], dtype=int).reshape(-1, 3)
        used = np.unique(self.triangle)
        low, high = points[used].min(axis=0), points[used].max(axis=0)
        self.unit = (points - (low + high) / 2) / max((high - low).max(), 1e-30)
        corners = self.unit[self.triangle]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        size = np.abs(normal).sum(axis=0)

        def footprint(axis):  # feet are apart; a nose, a hand or a tail is alone at its end
            height = self.unit[used, axis]
            feet = self.unit[used][height < height.min() + 0.04 * np.ptp(height)]
            return feet.std(axis=0).sum()

        up = max((1, 2), key=footprint)
        along = max((k for k in range(3) if k != up), key=lambda k: size[k])
        across = 3 - along - up
        turned = np.stack([self.unit[:, across], self.unit[:, up], self.unit[:, along]], axis=1)
        if np.linalg.det(np.eye(3)[[across, up, along]]) < 0:
            turned[:, 0] *= -1
        yaw, pitch = np.radians(25), np.radians(12)
        turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
        tilt = np.array([[1, 0, 0], [0, np.cos(pitch), -np.sin(pitch)], [0, np.sin(pitch), np.cos(pitch)]])
        self.screen = turned @ turn.T @ tilt.T
        corners = self.screen[self.triangle]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
        light = np.abs(normal @ np.array([0.3, 0.5, 0.81]))
        self.shade = 0.45 + 0.55 * light
        front = normal[:, 2] > 0
        if self._inside_out(corners, normal):
            front = ~front
        self.faces = np.nonzero(front)[0]
        self.faces = self.faces[np.argsort(corners[self.faces, :, 2].mean(axis=1))]

    @staticmethod
    def _inside_out(corners, normal):
        return (corners.mean(axis=1) * normal).sum() < 0

    def draw(self, axis, colors, alpha=1.0):
        """colors: vertices x 3, in [0,1]."""
        face = colors[self.triangle[self.faces]].mean(axis=1) * self.shade[self.faces, None]
        shapes = self.screen[self.triangle[self.faces]][:, :, :2]
        axis.add_collection(PolyCollection(shapes, facecolors=np.clip(face, 0, 1), edgecolors="face", linewidths=0.3,
                                           alpha=alpha))
        low, high = self.screen[self.triangle].reshape(-1, 3).min(axis=0), self.screen[self.triangle].reshape(-1, 3).max(axis=0)
        axis.set_xlim(low[0] - 0.02, high[0] + 0.02)
        axis.set_ylim(low[1] - 0.02, high[1] + 0.02)
        axis.set_aspect("equal")
        axis.axis("off")


def distinct(count):
    """Colours of which neighbours in number differ much."""
    return np.array([colorsys.hsv_to_rgb(i * 0.618 % 1, 0.45 + 0.35 * (i % 3) / 2, 0.75 + 0.25 * (i % 2))
                     for i in range(max(count, 1))])


def by_place(points):
    low, high = points.min(axis=0), points.max(axis=0)
    return 0.15 + 0.8 * (points - low) / np.maximum(high - low, 1e-30)


def error_colors(errors):
    return plt.get_cmap("Reds")(np.clip(np.array(errors) / 0.25, 0, 1) * 0.95)[:, :3]


def plot_meshes(folder, plots):
    with open(os.path.join(folder, "pictures.json")) as file:
        pictures = json.load(file)
    if not pictures:
        return
    views = [View(p) for p in pictures]
    shown = min(3, len(pictures))

    figure, axes = plt.subplots(1, shown, figsize=(4 * shown, 4.4), squeeze=False)
    for axis, picture, view in zip(axes[0], pictures, views):
        patch = np.array(picture["patch"])
        palette = np.vstack([distinct(patch.max() + 1), [0.6, 0.6, 0.6]])
        view.draw(axis, palette[patch])
        axis.set_title(picture["mesh"])
    save(plots, "patches", figure)

    figure, axes = plt.subplots(1, shown, figsize=(4 * shown, 4.4), squeeze=False)
    for axis, picture, view in zip(axes[0], pictures, views):
        view.draw(axis, np.full((len(view.screen), 3), 0.9), alpha=0.55)
        pairs = np.array(picture["pairs"], dtype=int).reshape(-1, 2)
        ends = view.screen[pairs][:, :, :2]
        palette = distinct(len(pairs)) * 0.8
        axis.add_collection(LineCollection(ends, colors=palette, linewidths=1.1))
        axis.scatter(ends[:, :, 0].ravel(), ends[:, :, 1].ravel(), s=12, c=np.repeat(palette, 2, axis=0), zorder=3)
        axis.set_title(picture["mesh"])
    save(plots, "pairs", figure)

    for number, (picture, view) in enumerate(zip(pictures, views)):
        maps = picture["maps"]
        place = by_place(view.unit)
        side = np.array(picture["side"])
        columns = 6
        blocks = (len(maps) + columns - 1) // columns
        extent = np.ptp(view.screen, axis=0)
        height = min(3.2, max(1.5, 2.0 * extent[1] / max(extent[0], 1e-30)))
        figure, axes = plt.subplots(2 * blocks, columns, figsize=(2.1 * columns, 2 * blocks * (height + 0.15)),
                                    squeeze=False)
        for axis in axes.ravel():
            axis.axis("off")
        for i, entry in enumerate(maps):
            partner = np.array(entry["partner"])
            colors = place.copy()
            right = (side < 0) & (partner >= 0)
            colors[right] = place[partner[right]]
            colors[partner < 0] = 0.5
            top, bottom = axes[2 * (i // columns)][i % columns], axes[2 * (i // columns) + 1][i % columns]
            view.draw(top, colors)
            top.set_title(entry["method"], fontsize=10)
            view.draw(bottom, error_colors(entry["error"]))
        figure.subplots_adjust(wspace=0.02, hspace=0.1)
        save(plots, f"map_{number}", figure, dpi=100)


def draw(folder):
    """All plots of the comparison in a folder: name -> bytes of a PNG file."""
    plots = {}
    plot_accuracy(folder, plots)
    plot_error_curves(folder, plots)
    plot_generations(folder, plots)
    plot_meshes(folder, plots)
    return plots
