"""Random bodies, cut along random paths: how far a family's replay is from the simulation of the very body, and how far
it is expected to be.

    tests/truth/random_bodies.py BIN FAMILY.dffd [--seeds FIRST LAST] [--uneven] [--keep DIR]

BIN is the folder of the commands. Each seed makes a plane, a cylinder, a sphere, a saddle, a torus or bumps, with radii of
30 mm and more; a path that is straight, an arc, an S or free, with bends of 15 mm and more, as deep everywhere or deeper to
one end, under an upright blade or one that leans by up to 40 degrees; bone below three bodies of ten; and two tensions in
any direction. cleft cut --simulate --field opens each; ends of cuts are left out of the errors as it leaves them out. Prints
a line for each body, then what part of the errors is within once and twice the expected one."""

import argparse
import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError as missing:
    print(f"Skipped: {missing}. Debian has python3-numpy.")
    sys.exit(77)

HALF = 85  # mm: half the width of a body


def surface(random):
    """Its name and its height over the plane."""
    kind = random.choice(["plane", "cylinder", "sphere", "saddle", "torus", "bumps"])
    first, second = random.uniform(30, 120, 2)
    turn = random.uniform(0, np.pi)
    phase, wave, high = random.uniform(0, 2 * np.pi, 2), 2 * np.pi / random.uniform(120, 200), random.uniform(2, 5)

    def height(x, y):
        along, across = x * np.cos(turn) + y * np.sin(turn), -x * np.sin(turn) + y * np.cos(turn)
        return {
            "plane": 0 * x,
            "cylinder": -along ** 2 / (2 * first),
            "sphere": -(x ** 2 + y ** 2) / (2 * max(first, 40)),
            "saddle": across ** 2 / (2 * max(second, 50)) - along ** 2 / (2 * max(first, 50)),
            "torus": -along ** 2 / (2 * first) - across ** 2 / (2 * second),
            "bumps": high * np.sin(wave * x + phase[0]) * np.cos(wave * y + phase[1]),
        }[kind]

    return kind, height


def uneven(height, random):
    """With a dozen waves of 15 to 60 mm in all directions, each a twentieth to a hundredth of its length high."""
    turn, phase = random.uniform(0, 2 * np.pi, (2, 12))
    length = np.exp(random.uniform(np.log(15), np.log(60), 12))
    high = length / 12 / random.uniform(20, 100)

    def with_waves(x, y):
        return height(x, y) + sum(
            h * np.sin(2 * np.pi / l * (x * np.cos(t) + y * np.sin(t)) + p)
            for h, l, t, p in zip(high, length, turn, phase))

    return with_waves


def write_surface(file, height, edge):
    places = np.linspace(-HALF, HALF, int(2 * HALF / edge) + 1)
    x, y = np.meshgrid(places, places)
    n = len(places)
    with open(file, "w", encoding="ascii") as out:
        for point in zip(x.ravel(), y.ravel(), height(x, y).ravel()):
            out.write("v %.6f %.6f %.6f\n" % point)
        for row in range(n - 1):
            for a in range(row * n + 1, row * n + n):
                out.write(f"f {a} {a + 1} {a + n + 1}\nf {a} {a + n + 1} {a + n}\n")


def normal_of(height, x, y):
    step = 1e-4
    normal = np.array([-(height(x + step, y) - height(x - step, y)) / (2 * step),
                       -(height(x, y + step) - height(x, y - step)) / (2 * step), 1.])
    return normal / np.linalg.norm(normal)


def write_path(file, height, random):
    """Returns what it is."""
    kind = random.choice(["straight", "arc", "S", "free"])
    radius, turned = random.uniform(15, 80), random.choice([-1, 1])
    length = {"straight": random.uniform(12, 90), "arc": min(random.uniform(15, 50), 2.2 * radius),
              "S": random.uniform(20, 55), "free": random.uniform(20, 60)}[kind]
    waves = random.uniform(-1, 1, 3) / 25
    s = np.linspace(0, length, 81)
    curvature = {
        "straight": 0 * s,
        "arc": turned / radius + 0 * s,
        "S": np.cos(np.pi * s / length) / max(radius, 16),
        "free": waves[0] + waves[1] * np.cos(2 * np.pi * s / length) + waves[2] * np.sin(2 * np.pi * s / length),
    }[kind]

    def integral(of):
        return np.concatenate([[0], np.cumsum((of[1:] + of[:-1]) / 2 * np.diff(s))])

    angle = random.uniform(0, 2 * np.pi) + integral(curvature)
    x, y = integral(np.cos(angle)), integral(np.sin(angle))
    middle, centre = len(s) // 2, random.uniform(-5, 5, 2)
    x, y = x - x[middle] + centre[0], y - y[middle] + centre[1]
    tilt = np.radians(random.choice([0, 0, random.uniform(-40, 40)]))
    deepens = random.choice([1, 1, 0.5, 2])
    depth = np.clip(random.uniform(1.5, 6) * np.linspace(1, deepens, len(s)), 1.5, 6)
    with open(file, "w", encoding="ascii") as out:
        out.write("x,y,z,nx,ny,nz,depth\n")
        for i in range(len(s)):
            normal = normal_of(height, x[i], y[i])
            along = np.array([np.cos(angle[i]), np.sin(angle[i]), 0])
            along -= along @ normal * normal
            blade = np.cos(tilt) * normal + np.sin(tilt) * np.cross(normal, along / np.linalg.norm(along))
            out.write("%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.4f\n" % (x[i], y[i], height(x[i], y[i]), *blade, depth[i]))
    return f"{kind}, {length:.0f} mm long, {depth[0]:.1f} to {depth[-1]:.1f} deep, tilted by {np.degrees(tilt):.0f}"


def compare(seed, command, family, folder, is_uneven):
    """The body in words, and the figures of cleft cut; none where it has refused."""
    random = np.random.default_rng(seed)
    name, height = surface(random)
    if is_uneven:
        name, height = f"uneven {name}", uneven(height, np.random.default_rng([seed, 1]))
    mesh, path = f"{folder}/{seed}.obj", f"{folder}/{seed}.csv"
    write_surface(mesh, height, 1.7)
    what = f"{name}, {write_path(path, height, random)}"
    arguments = [command, "--mesh", mesh, "--path", path, "--field", family, "--simulate", "--out", f"{folder}/{seed}.vtp",
                 "--json", "--quiet"]
    if random.random() < 0.3:
        turn, slope, depth = random.uniform(0, 2 * np.pi), random.uniform(0, 0.2), random.uniform(8, 12)
        write_surface(f"{folder}/{seed}-bone.obj", lambda x, y: height(x, y) - np.clip(
            depth + slope * (x * np.cos(turn) + y * np.sin(turn)), 6.5, 30), 3)
        arguments += ["--bone", f"{folder}/{seed}-bone.obj"]
        what += f", bone {depth:.0f} mm below with a slope of {slope:.2f}"
    turn, smaller = random.uniform(0, 2 * np.pi), random.uniform(0.005, 0.02)
    larger = smaller * random.uniform(1, 3)
    arguments += ["--tension", f"{np.cos(turn):.4f},{np.sin(turn):.4f},0", "--prestress", f"{larger:.4f},{smaller:.4f}"]
    result = subprocess.run(arguments, capture_output=True, text=True, check=False)
    return what, json.loads(result.stdout) if result.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("bin")
    parser.add_argument("family")
    parser.add_argument("--seeds", type=int, nargs=2, default=[0, 59])
    parser.add_argument("--uneven", action="store_true", help="waves of 15 to 60 mm in the skin")
    parser.add_argument("--keep", help="folder for meshes, paths and wounds")
    options = parser.parse_args()
    os.environ.update(CLEFT_BIN=options.bin)
    ratios = []
    print("| seed | body | opening, mm | error | expected | because |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for seed in range(options.seeds[0], options.seeds[1] + 1):
            what, figures = compare(seed, f"{options.bin}/cleft-cut", options.family, options.keep or scratch,
                                    options.uneven)
            if figures is None:
                print(f"| {seed} | {what} | refused | | | |", flush=True)
                continue
            simulated, cut = figures["simulated"], figures["cuts"][0]
            off, expected = simulated["replay"]["opening_off_by"], cut["expected_opening_error"]
            ratios.append(off / expected)
            print(f"| {seed} | {what} | {simulated['gape_mm']:.2f} | {off:.3f} | {expected:.3f} | "
                  f"{cut['expected_opening_error_because']} |", flush=True)
    ratios = np.array(ratios)
    print(f"\n{len(ratios)} bodies: within the expected error {np.mean(ratios <= 1):.0%}, within twice "
          f"{np.mean(ratios <= 2):.0%}; error over expected: median {np.median(ratios):.2f}, largest {ratios.max():.2f}")


main()
