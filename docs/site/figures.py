#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the drawings of docs/figures that are no results:   figures.py [OUT]

step.svg (one step of the solver), scene.svg (bodies, groups, levels), approximations.svg (which part stands for what) and
search.svg, the scenes of the default shot's search from the table in docs/validation/default-shot.md."""
import os
import re
import sys
from html import escape

HERE = os.path.dirname(os.path.abspath(__file__))
DOCS = os.path.dirname(HERE)
INK, DIM, LINE, SOFT = "#1c2430", "#5b6675", "#9aa5b1", "#f4f6f8"
BLUE, RED, GREEN, SAND = "#dbe9f8", "#f8dedb", "#dff1e0", "#f7eed8"
CLASS = {"none": "#9aa5b1", "scratch": "#2f77c0", "undecided": "#c98a16", "gouge": "#b8322a"}


def text(x, y, words, size=14, anchor="middle", colour=INK, weight="normal"):
    return (f'<text x="{x:g}" y="{y:g}" font-size="{size}" text-anchor="{anchor}" fill="{colour}" '
            f'font-weight="{weight}">{escape(words)}</text>')


def box(x, y, w, h, fill=SOFT, stroke=LINE, radius=6):
    return f'<rect x="{x:g}" y="{y:g}" width="{w:g}" height="{h:g}" rx="{radius}" fill="{fill}" stroke="{stroke}"/>'


def lines(x, y, rows, size=13):
    """A title and rows below it."""
    return "".join(text(x, y + 18 * k, row, size, weight="bold" if k == 0 else "normal", colour=INK if k == 0 else DIM)
                   for k, row in enumerate(rows))


def arrow(*points, colour=INK):
    path = " ".join(f"{x:g},{y:g}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.6" marker-end="url(#end)"/>'


def svg(width, height, *parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            'font-family="DejaVu Sans, Helvetica, sans-serif">\n'
            '<!-- drawn by docs/site/figures.py -->\n'
            '<defs><marker id="end" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
            f'<path d="M0,0 L8,4 L0,8 z" fill="{INK}"/></marker></defs>\n'
            f'<rect width="{width}" height="{height}" fill="#fff"/>\n' + "\n".join(parts) + "\n</svg>\n")


def step():
    """One step, from points to points."""
    stages = (("points to nodes", "mass, momentum, force, energy", "(N-3), mpm/kernel/p2g.c", BLUE),
              ("levels", "constrained nodes hand on", "(N-9), mpm/grid/interface.c", SAND),
              ("nodes", "boundaries, forces, contact", "(N-6), (M-6), mpm/kernel/nodes.c", GREEN),
              ("nodes to points", "velocity, gradient, heat", "(N-5), mpm/kernel/g2p.c", BLUE),
              ("law", "stress, damage, temperature", "(M-1) .. (M-5), mpm/law", RED),
              ("move", "places, cells, split points", "mpm/memory/movers.c", BLUE))
    parts, at = [], []
    for k, (name, what, where, fill) in enumerate(stages):
        column, row = (k, 0) if k < 3 else (5 - k, 1)
        x, y = 20 + 260 * column, 20 + 130 * row
        at.append((x, y))
        parts += [box(x, y, 225, 80, fill), lines(x + 112, y + 26, (name, what, where))]
    for k in range(5):
        (x, y), (u, v) = at[k], at[k + 1]
        if y == v:
            parts.append(arrow((x + (225 if u > x else 0), y + 40), (u + (0 if u > x else 225), v + 40)))
        else:
            parts.append(arrow((x + 112, y + 80), (u + 112, v)))
    (x, y), (u, v) = at[5], at[0]
    parts += [arrow((x + 112, y), (u + 112, v + 80)), text(u + 122, v + 108, "next step", 12, "start", DIM)]
    parts.append(text(395, 260, "Now and then, when all levels are in step: rules say where small cells are wanted (mpm/refine)", 12, colour=DIM))
    return svg(790, 275, *parts)


def scene():
    """An armature over a grain on a rail, with the cells of three levels."""
    parts = []
    left, top, surface, bottom = 20, 30, 170, 310
    for size, (x0, x1, y0, y1) in ((40, (left, 620, 90, 290)), (20, (180, 460, 110, 250)), (10, (260, 400, 130, 210))):
        parts.append(f'<rect x="{x0}" y="{y0}" width="{x1 - x0}" height="{y1 - y0}" fill="#fff"/>')
        across = [f"M{x},{y0} V{y1}" for x in range(x0, x1 + 1, size)] + [f"M{x0},{y} H{x1}" for y in range(y0, y1 + 1, size)]
        parts.append(f'<path d="{" ".join(across)}" stroke="#d3dae2" fill="none"/>')
    parts += [f'<rect x="{left}" y="{surface}" width="600" height="120" fill="#d98f4e" opacity="0.35" stroke="#a5602a"/>',
              f'<path d="M300,{surface} a30,30 0 0 1 60,0 z" fill="#b5651d" stroke="#7d4514"/>',
              f'<path d="M{left},{surface - 6} L240,{surface - 6} L300,{top + 50} L300,{top} L{left},{top} z" fill="#9db7d5" opacity="0.75" stroke="#44658c"/>',
              arrow((310, 50), (390, 50)), text(398, 55, "velocity", 13, "start"),
              text(120, 80, "armature: group 1", 13), text(120, 270, "rail: group 2", 13),
              arrow((440, 120), (362, 150)), text(445, 124, "grain, welded to the rail: group 2 too", 13, "start"),
              text(20, 335, "level 0: finest cells, where metal flows;  level 1, level 2: each twice as wide", 13, "start", DIM),
              text(20, 355, "at a change of level constrained nodes depend on the other level's; contact acts between groups 1 and 2", 13, "start", DIM),
              text(left + 2, bottom - 8, "absorbing", 11, "start", DIM), text(618, bottom - 8, "absorbing", 11, "end", DIM)]
    return svg(790, 370, *parts)


def approximations():
    """What each part stands for, from the shot to the answer."""
    rows = (("shot", "circuit of lumped parts; rails as a ladder", "full 3-D fields of the bore", "(C-1), (C-2), (C-11)", BLUE),
            ("arrival at a grain", "planar shock over hardness: skip or compute", "nothing is decided by it alone", "(M-22)", SAND),
            ("scene", "material points, laws of metals", "conduction, grain structure", "(N-3) .. (N-5), (M-1) .. (M-6)", GREEN),
            ("class of a groove", "growth and shape at a second gauge", "the whole crater", "(O-3), (O-4)", GREEN),
            ("threshold", "bracket, cells, grids, inputs", "other grains, bonds, metals", "(O-5)", RED),
            ("place of onset", "x(v) of the shot, random grains", "a count of real grains", "onset.md", RED))
    parts = [text(110, 24, "step", 13, weight="bold"), text(225, 24, "stands for it", 13, "start", weight="bold"),
             text(540, 24, "not in it", 13, "start", weight="bold")]
    for k, (name, stands, lacks, where, fill) in enumerate(rows):
        y = 36 + 64 * k
        parts += [box(15, y, 190, 46, fill), text(110, y + 20, name, 14, weight="bold"), text(110, y + 37, where, 11, colour=DIM),
                  text(225, y + 28, stands, 13, "start"), text(540, y + 28, lacks, 13, "start", DIM)]
        if k + 1 < len(rows):
            parts.append(arrow((110, y + 46), (110, y + 64)))
    return svg(770, 36 + 64 * len(rows), *parts)


def scenes_of(page):
    """Velocity [m/s], growth [1/us] and class of the scenes in the page's first table."""
    found, table = [], re.search(r"^\| v \[m/s\] \|.*?\n\n", page, flags=re.S | re.M).group()
    for row in re.findall(r"^\| (\d[^|]*)\|([^|]*)\|[^|]*\|[^|]*\|([^|]*)\|$", table, flags=re.M):
        speeds = [float(v) for v in re.findall(r"\d+", row[0].split(",")[0])]
        growths = [float(g) for g in re.findall(r"-?[\d.]+", row[1])]
        classes = [c.strip() for c in row[2].split(",")]
        speeds = speeds * len(growths) if len(speeds) == 1 else speeds
        classes = classes * len(growths) if len(classes) == 1 else classes
        if all(c in CLASS for c in classes):
            found += zip(speeds, growths, classes)
    return found


def search():
    """The scenes of the default shot's search: growth and class over velocity, with both intervals."""
    with open(os.path.join(DOCS, "validation", "default-shot.md"), encoding="utf-8") as file:
        page = file.read()
    speeds = re.search(r"gouges from (\d+) m/s \((\d+) \.\. (\d+)\).*?scratches from (\d+) m/s \((\d+) \.\. (\d+)\)", page, flags=re.S)
    numbers = [float(number) for number in speeds.groups()]
    x_of, y_of = (lambda v: 60 + (v - 300) * 0.47), (lambda g: 165 - g * 480)
    parts = [f'<path d="M60,{y_of(0):g} H700" stroke="{LINE}"/>', text(700, y_of(0) + 16, "growth 0", 11, "end", DIM)]
    for v in range(400, 1700, 200):
        parts += [f'<path d="M{x_of(v):g},320 v6" stroke="{INK}"/>', text(x_of(v), 340, str(v), 12)]
    parts += [f'<path d="M60,320 H700 M60,320 V30" stroke="{INK}" fill="none"/>', text(380, 362, "velocity [m/s]", 13),
              text(16, 26, "growth [1/us]", 13, "start")]
    for g in (-0.1, 0.1, 0.2):
        parts += [f'<path d="M54,{y_of(g):g} h6" stroke="{INK}"/>', text(50, y_of(g) + 4, f"{g:g}", 11, "end")]
    for (middle, low, high), y, name, colour in ((numbers[:3], 285, "threshold", CLASS["gouge"]), (numbers[3:], 303, "scratch velocity", CLASS["scratch"])):
        parts += [f'<path d="M{x_of(low):g},{y} H{x_of(high):g}" stroke="{colour}" stroke-width="6" opacity="0.4"/>',
                  f'<circle cx="{x_of(middle):g}" cy="{y}" r="4" fill="{colour}"/>',
                  text(x_of(high) + 8, y + 4, f"{name} {middle:g} ({low:g} .. {high:g})", 12, "start", colour)]
    for v, g, kind in scenes_of(page):
        parts.append(f'<circle cx="{x_of(v):g}" cy="{y_of(g):g}" r="6" fill="{CLASS[kind]}" stroke="#fff"/>')
    for k, kind in enumerate(("scratch", "undecided", "gouge")):
        parts += [f'<circle cx="90" cy="{50 + 20 * k}" r="6" fill="{CLASS[kind]}"/>', text(104, 54 + 20 * k, kind, 12, "start")]
    return svg(720, 375, *parts)


FIGURES = {"step": step, "scene": scene, "approximations": approximations, "search": search}


def main():
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(DOCS, "figures")
    for name, draw in FIGURES.items():
        with open(os.path.join(out, name + ".svg"), "w", encoding="utf-8") as file:
            file.write(draw())


if __name__ == "__main__":
    main()
