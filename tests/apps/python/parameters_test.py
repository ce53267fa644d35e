"""Parameters of five surfaces, computed again with NumPy from their definitions."""

import unittest

import numpy
import rugosa

DX, DY, N = 0.002, 0.003, 96


def surfaces():
    """Five surfaces of N x N nodes, mm: smooth, noise, milled, plateau with grooves, quantised."""
    x, y = numpy.meshgrid(DX * numpy.arange(N), DY * numpy.arange(N))
    noise = numpy.random.default_rng(3).normal(0, 1, (N, N))
    waves = numpy.fft.fftfreq(N)
    smooth = numpy.fft.ifft2(numpy.fft.fft2(noise) / (1e-3 + waves[:, None]**2 + waves**2)**1.5).real
    milled = numpy.abs(numpy.sin(2 * numpy.pi * (x + 0.1 * y) / 0.031)) + 0.02 * noise
    plateau = -numpy.maximum(0, smooth / smooth.std() - 0.5) + 0.02 * noise
    return {"smooth": 1e-3 * smooth / smooth.std(), "noise": 1e-3 * noise, "milled": 2e-3 * milled,
            "plateau": 1e-3 * plateau, "quantised": 1e-4 * numpy.round(10 * smooth / smooth.std())}


def triangles(z):
    """Areas of the triangles between nodes by cross products, over that of the map, less 1; both diagonals."""
    x, y = numpy.meshgrid(DX * numpy.arange(N), DY * numpy.arange(N))
    points = numpy.stack([x, y, z], axis=-1)
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, :-1], points[1:, 1:]
    area = sum(numpy.linalg.norm(numpy.cross(q - p, r - p), axis=-1).sum() / 2
               for p, q, r in ((a, b, c), (d, b, c), (b, a, d), (c, a, d))) / 2
    return area / (DX * DY * (N - 1)**2) - 1


def core(heights):
    """Sk, Spk and Svk from the material ratio curve on 200,001 ratios, and a line through its flattest 40 %."""
    share = numpy.linspace(0, 1, 200001)
    count = heights.size
    curve = numpy.interp(share, (numpy.arange(count) + 0.5) / count, numpy.sort(heights.ravel())[::-1])
    window = 80000
    first = numpy.argmin(curve[:-window] - curve[window:])
    slope, upper = numpy.polyfit(share[first:first + window], curve[first:first + window], 1)
    lower = upper + slope
    peaks, valleys = numpy.maximum(curve - upper, 0), numpy.maximum(lower - curve, 0)
    return {"Sk": upper - lower, "Spk": 2 * peaks.mean() / max((peaks > 0).mean(), 1e-12),
            "Svk": 2 * valleys.mean() / max((valleys > 0).mean(), 1e-12)}


def texture(z):
    """Sal and Str from sums over the overlapping nodes, along 180 rays of 5,000 steps; whether Str is a bound."""
    z, half = z - z.mean(), N // 2
    correlation = numpy.empty((half + 1, N + 1))  # of lags 0 to half along y, -half to half along x
    for j in range(half + 1):
        for i in range(-half, half + 1):
            low, high = z[:N - j, max(0, -i):N - max(0, i)], z[j:, max(0, i):N - max(0, -i)]
            correlation[j, i + half] = (low * high).mean() / (z**2).mean()
    decays, edges = [], []
    for angle in numpy.pi * numpy.arange(180) / 180:
        along, up = numpy.cos(angle) / DX, numpy.sin(angle) / DY
        edge = half / max(abs(along), abs(up))
        r = numpy.linspace(0, edge, 5001)[:-1]
        x, y = r * along + half, r * up
        i, j = x.astype(int), y.astype(int)
        u, v = x - i, y - j
        ray = (1 - v) * ((1 - u) * correlation[j, i] + u * correlation[j, numpy.minimum(i + 1, N)]) + \
            v * ((1 - u) * correlation[j + 1, i] + u * correlation[j + 1, numpy.minimum(i + 1, N)])
        below = numpy.flatnonzero(ray <= 0.2)
        (decays if below.size else edges).append(r[below[0]] if below.size else edge)
    return min(decays), min(decays) / max(decays + edges)


def areal(z):
    z = z - z.mean()
    q = numpy.sqrt((z**2).mean())
    seven = numpy.array([-1, 9, -45, 0, 45, -9, 1]) / 60

    def slope(line):
        return numpy.correlate(line, seven, "valid")

    along = numpy.apply_along_axis(slope, 1, z)[3:-3] / DX
    across = numpy.apply_along_axis(slope, 0, z)[:, 3:-3] / DY
    return {"Sa": numpy.abs(z).mean(), "Sq": q, "Ssk": (z**3).mean() / q**3, "Sku": (z**4).mean() / q**4, "Sp": z.max(),
            "Sv": -z.min(), "Sz": z.max() - z.min(), "Sdq": numpy.sqrt((along**2 + across**2).mean()),
            "Sdr": triangles(z), "Smr": (z > 0).mean(), **core(z)}


def mean_width(z):
    """Pc elements: mean distance of crossings that are followed by a dale beyond a tenth, from both ends."""
    found = []
    for line in (z - z.mean(), (z - z.mean())[::-1]):
        side, starts, crossing = 0, [], 0
        for i in range(len(line)):
            if i > 0 and (line[i] > 0) != (line[i - 1] > 0):
                crossing = i - 1 + line[i - 1] / (line[i - 1] - line[i])
            now = 1 if line[i] > line.max() / 10 else -1 if line[i] < line.min() / 10 else 0
            if now and now != side:
                starts.append(crossing)
                side = now
        starts = starts[1:]
        found += [b - a for a, b in zip(starts[::2], starts[2::2])]
    return DX * numpy.mean(found)


class Parameters(unittest.TestCase):
    def test_areal_parameters_agree_with_their_definitions(self):
        for name, z in surfaces().items():
            found = rugosa.Surface(z, (DX, DY)).roughness()
            for key, value in areal(z).items():
                with self.subTest(surface=name, parameter=key):
                    error = 1e-9 if key not in ("Sk", "Spk", "Svk") else 0.1 if name == "quantised" else 6e-3
                    self.assertAlmostEqual(found[key] / value, 1, delta=error)

    def test_texture_agrees_with_sums_over_nodes(self):
        for name, z in surfaces().items():
            found = rugosa.Surface(z, (DX, DY)).roughness()
            for key, value in zip(("Sal", "Str"), texture(z)):
                with self.subTest(surface=name, parameter=key):
                    self.assertAlmostEqual(found[key] / value, 1, delta=0.01)
            if name == "milled":  # waves along (1, 0.1)
                self.assertAlmostEqual(found["Std"], 90 + numpy.degrees(numpy.arctan(0.1)), delta=1)

    def test_the_width_of_profile_elements_agrees(self):
        for name, z in surfaces().items():
            with self.subTest(surface=name):
                self.assertAlmostEqual(rugosa.Profile(z[7], DX).roughness()["PSm"] / mean_width(z[7]), 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
