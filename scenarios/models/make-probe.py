#!/usr/bin/env python3
"""Writes probe.obj: a made-up space probe as a drawing program would export it.

Lengths are in mm and y is up. The bus is a hexagonal prism of polygons; the panels are thin closed boxes
whose cells have a material of their own; the dish is a thin shell whose corners carry the normals of the
paraboloid, so that it shines as the curved surface that it stands for.

usage: make-probe.py [FILE]
"""
import math
import sys

BUS_RADIUS = 1100.0  # mm, of the circle through its corners
BUS_BOTTOM, BUS_TOP = -1200.0, 1200.0  # mm
PANEL = (5200.0, 30.0, 1800.0)  # mm, along x, y, z
PANEL_GAP = 900.0  # mm between the bus and a panel
DISH_RADIUS, DISH_DEPTH, DISH_SHELL = 1500.0, 375.0, 20.0  # mm
DISH_VERTEX = 1500.0  # mm, height of its deepest point
DISH_SIDES, DISH_RINGS = 24, 5


def number(value, digits):
    """Text with so many digits; never -0."""
    return f"{round(value, digits) + 0.0:.{digits}f}"


class Mesh:
    """The lines of a file, and how many vertices and normals they have."""

    def __init__(self):
        self.lines = []
        self.n_vertices = 0
        self.n_normals = 0

    def add(self, line):
        self.lines.append(line)

    def vertex(self, x, y, z):
        self.add("v " + " ".join(number(value, 4) for value in (x, y, z)))
        self.n_vertices += 1
        return self.n_vertices

    def normal(self, x, y, z):
        size = math.sqrt(x * x + y * y + z * z)
        self.add("vn " + " ".join(number(value / size, 7) for value in (x, y, z)))
        self.n_normals += 1
        return self.n_normals

    def face(self, corners, normals=None):
        if normals:
            self.add("f " + " ".join(f"{c}//{n}" for c, n in zip(corners, normals)))
        else:
            self.add("f " + " ".join(map(str, corners)))


def add_bus(mesh):
    mesh.add("o bus")
    mesh.add("usemtl Foil")
    turns = [math.radians(60 * k) for k in range(6)]
    rings = [[mesh.vertex(BUS_RADIUS * math.cos(a), y, -BUS_RADIUS * math.sin(a)) for a in turns]
             for y in (BUS_BOTTOM, BUS_TOP)]
    low, high = rings
    for k in range(6):
        after = (k + 1) % 6
        mesh.face([low[k], low[after], high[after], high[k]])
    mesh.face(high)
    mesh.face(low[::-1])


def add_panel(mesh, name, side):
    """side: +1 or -1, along x. The cells look along -y, away from the dish."""
    mesh.add(f"o {name}")
    half = [length / 2 for length in PANEL]
    middle = side * (BUS_RADIUS + PANEL_GAP + half[0])
    corner = {(i, j, k): mesh.vertex(middle + i * half[0], j * half[1], k * half[2])
              for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)}
    mesh.add("usemtl Cells")
    mesh.face([corner[c] for c in ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1))])
    mesh.add("usemtl White")
    mesh.face([corner[c] for c in ((-1, 1, -1), (-1, 1, 1), (1, 1, 1), (1, 1, -1))])
    mesh.face([corner[c] for c in ((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))])
    mesh.face([corner[c] for c in ((1, -1, -1), (-1, -1, -1), (-1, 1, -1), (1, 1, -1))])
    mesh.face([corner[c] for c in ((1, -1, 1), (1, -1, -1), (1, 1, -1), (1, 1, 1))])
    mesh.face([corner[c] for c in ((-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (-1, 1, -1))])


def add_shell(mesh, inside, lift):
    """One side of the dish; returns the corners of its rim. inside: the hollow side, which looks up."""
    slope = 2 * DISH_DEPTH / DISH_RADIUS**2  # of the paraboloid y = slope r^2 / 2
    sense = 1 if inside else -1
    rings = []
    for ring in range(DISH_RINGS + 1):
        radius = DISH_RADIUS * ring / DISH_RINGS
        corners = []
        for k in range(DISH_SIDES if ring else 1):
            a = 2 * math.pi * k / DISH_SIDES
            x, z = radius * math.cos(a), -radius * math.sin(a)
            corners.append((mesh.vertex(x, DISH_VERTEX + lift + slope * radius**2 / 2, z),
                            mesh.normal(-sense * slope * x, sense, -sense * slope * z)))
        rings.append(corners)
    for inner, outer in zip(rings, rings[1:]):
        for k in range(DISH_SIDES):
            after = (k + 1) % DISH_SIDES
            ring = [outer[k], outer[after]]
            ring += [inner[0]] if len(inner) == 1 else [inner[after], inner[k]]
            if not inside:
                ring.reverse()
            mesh.face([c for c, _ in ring], [n for _, n in ring])
    return [c for c, _ in rings[-1]]


def add_dish(mesh):
    mesh.add("o dish")
    mesh.add("usemtl White")
    mesh.add("g hollow side")
    above = add_shell(mesh, True, DISH_SHELL)
    mesh.add("g back")
    below = add_shell(mesh, False, 0.0)
    mesh.add("g rim")
    for k in range(DISH_SIDES):
        after = (k + 1) % DISH_SIDES
        mesh.face([below[k], below[after], above[after], above[k]])


def main():
    mesh = Mesh()
    mesh.add("# A made-up space probe; mm, y up. Written by make-probe.py.")
    add_bus(mesh)
    add_panel(mesh, "panel-plus", 1)
    add_panel(mesh, "panel-minus", -1)
    add_dish(mesh)
    mesh.add(f"# {mesh.n_vertices} vertices; the end")
    with open(sys.argv[1] if len(sys.argv) > 1 else "probe.obj", "w", encoding="ascii", newline="\n") as out:
        out.write("\n".join(mesh.lines) + "\n")


if __name__ == "__main__":
    main()
