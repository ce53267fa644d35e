"""One surface in every format: written here from the formats' descriptions, read by the program and the module."""

import io
import itertools
import struct
import unittest
import zipfile
import zlib
from decimal import Decimal

import numpy
import rugosa

from common import WithFolder

COLUMNS, ROWS = 14, 12
STEPS = numpy.random.default_rng(5).integers(0, 4096, (ROWS, COLUMNS))  # 12 bits, in nm
DX, DY = Decimal("0.5"), Decimal("0.75")  # µm
NM = {"m": Decimal("1e-9"), "mm": Decimal("1e-6"), "um": Decimal("1e-3"), "nm": Decimal(1)}
HOLES = {"none": [], "one": [(4, 5)], "several": [(0, 0), (3, 13), (7, 6), (7, 7), (8, 6)]}
ENDS = {"unix": "\n", "windows": "\r\n", "macintosh": "\r"}


def length(um, unit):
    """A length in µm as a decimal in a unit."""
    return format((um * 1000 * NM[unit]).normalize(), "f")


def cells(unit, holes, word="NaN"):
    return [[word if (j, i) in holes else format((int(k) * NM[unit]).normalize(), "f") for i, k in enumerate(row)]
            for j, row in enumerate(STEPS)]


def marked(holes, mark, kind):
    steps = STEPS.astype(kind)
    for j, i in holes:
        steps[j, i] = mark
    return steps


HEADERS = {
    "gwyddion": lambda u: f"# Channel: Topography\n# Width: {length(DX * COLUMNS, u)} {u}\n"
                          f"# Height: {length(DY * ROWS, u)} {u}\n# Value units: {u}\n",
    "spip": lambda u: f"# File Format = ASCII\n# x-pixels = {COLUMNS}\n# y-pixels = {ROWS}\n"
                      f"# x-length = {length(DX * COLUMNS, u)}\n# y-length = {length(DY * ROWS, u)}\n"
                      f"# x-unit = {u}\n# y-unit = {u}\n# z-unit = {u}\n# Start of Data:\n",
    "keys": lambda u: f"dx ({u}): {length(DX, u)}\ndy ({u}): {length(DY, u)}\nZ Unit: {u}\n",
    "names": lambda u: f"X step = {length(DX, u)} {u}\nY step = {length(DY, u)} {u}\n\nz [{u}]\n",
    "quoted": lambda u: f'"Model","VK"\n"X Calibration","{length(DX, u)}","{u}"\n"Y Calibration","{length(DY, u)}",'
                        f'"{u}"\n"Horizontal","{COLUMNS}"\n"Vertical","{ROWS}"\n"Unit","{u}"\n""\n"Height"\n',
}
LIST_HEADERS = {
    "gwyddion": lambda u: f"# x [{u}] y [{u}] z [{u}]\n",
    "spip": lambda u: f"# x-unit = {u}\n# y-unit = {u}\n# z-unit = {u}\n",
    "keys": lambda u: f"Unit: {u}\n",
    "names": lambda u: f"x/{u}\ty/{u}\tz/{u}\n",
    "quoted": lambda u: f'"X ({u})"\t"Y ({u})"\t"Height ({u})"\n',
}


def text(form, unit, missing, header, ends):
    holes = HOLES[missing]
    if form == "list":
        rows = [f"{length(DX * i, unit)}\t{length(DY * j, unit)}\t{cell}\n" for j, row in
                enumerate(cells(unit, holes)) for i, cell in enumerate(row)]
        body = LIST_HEADERS[header](unit) + "".join(rows[::-1])
    else:
        mark, word = {"tabs": ("\t", "BAD"), "commas": (",", ""), "semicolons": (";", "--")}[form]
        body = "".join(mark.join(row) + "\n" for row in cells(unit, holes, word))
        body = HEADERS[header](unit) + (body.replace(".", ",") if form == "semicolons" else body)
    return body.replace("\n", ENDS[ends]).encode()


def sdf(holes, version):
    head = struct.pack("<8s10s12s12s", b"bISO-%d.0" % version, b"", b"", b"")
    head += struct.pack("<HH" if version == 1 else "<II", COLUMNS, ROWS)
    return head + struct.pack("<ddddbbb", float(DX) * 1e-6, float(DY) * 1e-6, 1e-9, -1, 0, 5, 0) + \
        marked(holes, -32768, "<i2").tobytes()


def ascii_sdf(holes):
    return (f"aISO-1.0\nNumPoints = {COLUMNS}\nNumProfiles = {ROWS}\nXscale = 5e-7\nYscale = 7.5e-7\nZscale = 1e-9\n"
            "*\n" + "\n".join(" ".join(row) for row in cells("nm", holes, "BAD")) + "\n*\n").encode()


def sur(holes, unit, packed):
    head = bytearray(512)
    head[:12] = b"DSCOMPRESSED" if packed else b"DIGITAL SURF"
    for place, kind, value in ((14, "h", 1), (16, "h", 1), (18, "h", 2), (86, "h", 1), (98, "h", 32), (100, "i", 0),
                               (104, "i", 4095), (108, "i", COLUMNS), (112, "i", ROWS),
                               (120, "f", length(DX, unit)), (124, "f", length(DY, unit)), (128, "f", NM[unit])):
        struct.pack_into("<" + kind, head, place, float(value) if kind == "f" else value)
    for place in (180, 196, 212):
        head[place:place + 2] = unit.replace("u", "\xb5").encode("latin-1").ljust(2)
    steps = marked(holes, -2, "<i4").tobytes()
    if packed:  # in two streams
        parts = [(part, zlib.compress(part)) for part in (steps[:100], steps[100:])]
        steps = struct.pack("<I", 2) + b"".join(struct.pack("<II", len(a), len(b)) for a, b in parts) + \
            b"".join(b for _, b in parts)
    return bytes(head) + steps


def gsf(holes, unit):
    text = f"Gwyddion Simple Field 1.0\nXRes = {COLUMNS}\nYRes = {ROWS}\nXReal = 7e-6\nYReal = 9e-6\nXYUnits = m\n" \
           f"ZUnits = {unit}\n"
    steps = marked(holes, numpy.nan, float) * float(NM[unit])
    return text.encode() + bytes(4 - len(text) % 4) + steps.astype("<f4").tobytes()


def gwy(holes, unit):
    def item(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + value

    def thing(name, *items):
        body = b"".join(items)
        return name.encode() + b"\0" + struct.pack("<I", len(body)) + body

    def field(values, z):
        return thing("GwyDataField", item("xres", "i", struct.pack("<i", COLUMNS)),
                     item("yres", "i", struct.pack("<i", ROWS)), item("xreal", "d", struct.pack("<d", 7)),
                     item("yreal", "d", struct.pack("<d", 9)),
                     item("si_unit_xy", "o", thing("GwySIUnit", item("unitstr", "s", "µm\0".encode()))),
                     item("si_unit_z", "o", thing("GwySIUnit", item("unitstr", "s", z.encode() + b"\0"))),
                     item("data", "D", struct.pack("<I", values.size) + values.astype("<f8").tobytes()))

    mask = numpy.zeros(STEPS.shape)
    for place in holes:
        mask[place] = 1
    return b"GWYP" + thing("GwyContainer", item("/0/data", "o", field(STEPS, "V")),
                           item("/0/data/title", "s", b"Current\0"), item("/0/visible", "b", b"\1"),
                           item("/3/data", "o", field(STEPS * float(NM[unit]), unit)),
                           item("/3/mask", "o", field(mask, "")), item("list", "S", struct.pack("<I", 2) + b"a\0b\0"))


def archive(**entries):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as zipped:
        for name, content in entries.items():
            zipped.writestr(name.replace("__", "/"), content)
    return file.getvalue()


def x3p(holes, folder=""):
    axes = "".join(f"<C{axis}><AxisType>{kind}</AxisType><DataType>D</DataType><Increment>{step}</Increment></C{axis}>"
                   for axis, kind, step in (("X", "I", 5e-7), ("Y", "I", 7.5e-7), ("Z", "A", 1e-9)))
    xml = f'<p:ISO5436_2 xmlns:p="u"><Record1><Axes>{axes}</Axes></Record1><Record3><MatrixDimension><SizeX>{COLUMNS}' \
          f"</SizeX><SizeY>{ROWS}</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>bindata/data.bin" \
          "</PointDataLink></DataLink></Record3></p:ISO5436_2>"
    return archive(**{folder + "main.xml": xml,
                      folder + "bindata__data.bin": marked(holes, numpy.nan, "<f8").tobytes()})


def xlsx(holes, unit):
    rows = [["dx", length(DX, unit) + " " + unit], ["dy", length(DY, unit) + " " + unit], ["Unit", unit]]
    shared = [cell for row in rows for cell in row]
    lines = ["".join(f'<c r="{chr(65 + k)}{r + 1}" t="s"><v>{2 * r + k}</v></c>' for k in (0, 1)) for r in range(3)]
    lines += ["".join(f'<c r="{chr(65 + i)}{j + 5}"><v>{cell}</v></c>' for i, cell in enumerate(row) if cell)
              for j, row in enumerate(cells(unit, holes, ""))]
    strings = "".join(f"<si><t>{word}</t></si>" for word in shared)
    return archive(**{"xl__workbook.xml": "<workbook/>", "xl__sharedStrings.xml": f"<sst>{strings}</sst>",
                      "xl__worksheets__sheet1.xml": "<worksheet><sheetData><row><c t='inlineStr'><is><t>a note</t></is>"
                                                    "</c></row></sheetData></worksheet>",
                      "xl__worksheets__sheet2.xml": "<worksheet><sheetData>" + "".join(
                          f"<row>{line}</row>" for line in lines) + "</sheetData></worksheet>"})


def wyko(holes, in_nm):
    heights = cells("nm", holes, "Bad")
    if not in_nm:  # in wavelengths of 500 nm, twice as high
        heights = [[cell if cell == "Bad" else str(Decimal(cell) / 250) for cell in row] for row in heights]
    head = f"Wyko ASCII Data File Format 0\t{int(in_nm)}\t1\nX Size\t{COLUMNS}\nY Size\t{ROWS}\n" \
           "Block Name\tType\tLength\tValue\nWavelength\t7\t4\t500\nMult\t6\t2\t2\nAspect\t7\t4\t0.6666666666666666\n" \
           f"Pixel_size\t7\t4\t0.00075\nRAW_DATA\t3\t{4 * STEPS.size}\n"
    return (head + "\n".join("\t".join(column) for column in zip(*heights)) + "\nIntensity\t3\t4\n1\t2\n").encode()


def zygo(holes):
    head = f'Zygo XYZ Data File - Format 1\n0 3 0 0 "date"\n0 0 {COLUMNS} {ROWS} 1 255\n10 20 {COLUMNS} {ROWS}\n""\n""\n' \
           '""\n0 0 6.3e-07 0.5 1 0 5e-7 1\n3 2 0 0 0 6 0 ""\n0 0 1 3\n0 1 1\n0 ""\n1 5 0\n#\n'
    return (head + "".join(f"{10 + i} {20 + j} {cell}\n" for j, row in enumerate(cells("um", holes, "No Data"))
                           for i, cell in enumerate(row)) + "#\n").encode()


def pairwise(*factors):
    """Combinations that hold every pair of values of two factors."""
    pairs = {(a, x, b, y) for a, b in itertools.combinations(range(len(factors)), 2)
             for x in factors[a] for y in factors[b]}
    every = list(itertools.product(*factors))
    while pairs:
        covered = max((({p for p in pairs if row[p[0]] == p[1] and row[p[2]] == p[3]}, row) for row in every),
                      key=lambda found: len(found[0]))
        pairs -= covered[0]
        yield covered[1]


def files():
    """Names, contents, missing points and the spacing along y (µm) of all files."""
    for form, unit, missing, header, ends in pairwise(("tabs", "commas", "semicolons", "list"), NM, HOLES, HEADERS, ENDS):
        yield f"{form}-{unit}-{missing}-{header}-{ends}.txt", text(form, unit, missing, header, ends), missing, DY
    for missing, holes in HOLES.items():
        fixed = {"sdf1.sdf": sdf(holes, 1), "sdf2.sdf": sdf(holes, 2), "text.sdf": ascii_sdf(holes), "x3p.x3p": x3p(holes),
                 "folder.x3p": x3p(holes, "scan__"), "nm.asc": wyko(holes, True), "waves.asc": wyko(holes, False)}
        for name, content in fixed.items():
            yield f"{missing}-{name}", content, missing, DY
        yield f"{missing}-zygo.xyz", zygo(holes), missing, DX
    for unit, missing in pairwise(NM, HOLES):
        holes = HOLES[missing]
        for name, content in (("plain.sur", sur(holes, unit, False)), ("packed.sur", sur(holes, unit, True)),
                              ("gwy", gwy(holes, unit)), ("xlsx", xlsx(holes, unit)), ("gsf", gsf(holes, unit))):
            yield f"{unit}-{missing}.{name}", content, missing, DY


class SurfaceFiles(WithFolder):
    def test_every_file_is_read_as_written(self):
        names = set()
        for name, content, missing, dy in files():
            names.add(name)
            (self.folder / name).write_bytes(content)
            measured = numpy.ones(STEPS.shape, bool)
            for place in HOLES[missing]:
                measured[place] = False
            error = 1e-7 if name.endswith("gsf") and not name.startswith("nm") else 1e-14  # floats
            with self.subTest(name):
                if missing != "none":
                    with self.assertRaisesRegex(rugosa.InputError, "fill"):
                        rugosa.read(self.folder / name, surface=True)
                read = rugosa.read(self.folder / name, surface=True, fill=True, detrend="none")
                numpy.testing.assert_allclose(read.spacing, [float(DX) * 1e-3, float(dy) * 1e-3], rtol=1e-14)
                self.assertEqual(read.heights.shape, STEPS.shape)
                numpy.testing.assert_allclose(read.heights[measured], 1e-6 * STEPS[measured], rtol=error, atol=1e-18)
        self.assertGreaterEqual(len(names), 60)
        for name in sorted(names)[::6]:
            with self.subTest(name):
                self.rugosa("profile", "--surface", name, "--fill", "--out", "o", "--force", "--pictures", "off")
                shown = numpy.loadtxt(self.folder / "o/heights.txt", delimiter=",")
                numpy.testing.assert_array_equal(shown, rugosa.read(self.folder / name, surface=True, fill=True).heights)

    def test_every_format_gives_the_same_contact_curve(self):
        heights = 1e-6 * STEPS
        right = rugosa.contact(heights, (5e-4, 7.5e-4), kernel="periodic", steps=3)
        whole = [(name, content) for name, content, missing, dy in files() if missing == "none" and dy == DY]
        self.rugosa("profile", "--surface", self.saved(whole[0]), "--detrend", "none", "--out", "o")
        whole += [("again." + kind, (self.folder / "o" / ("surface." + kind)).read_bytes()) for kind in ("x3p", "sur")]
        for name, content in whole:
            if name.endswith("gsf") and not name.startswith("nm"):
                continue  # floats of 32 bits hold whole numbers only
            with self.subTest(name):
                read = rugosa.read(self.folder / self.saved((name, content)), surface=True, detrend="none")
                curve = rugosa.contact(read, kernel="periodic", steps=3)
                for column in ("pressure", "contact_fraction", "tangent_stiffness", "displacement"):
                    numpy.testing.assert_allclose(getattr(curve, column), getattr(right, column), rtol=1e-12)

    def saved(self, file):
        (self.folder / file[0]).write_bytes(file[1])
        return file[0]

    def test_masked_points_are_missing_points(self):
        x = numpy.linspace(-1, 1, 65)
        parabola = -1e-3 * x**2
        dead = parabola.copy()
        dead[10] = 1e-2
        masked = numpy.ma.masked_array(dead, mask=numpy.arange(65) == 10)
        with self.assertRaisesRegex(rugosa.InputError, "1 missing point .* fill"):
            rugosa.contact(masked, 0.01, steps=2)
        filled = rugosa.contact(masked, 0.01, steps=2, fill=True)
        right = rugosa.contact(parabola, 0.01, steps=2)
        numpy.testing.assert_allclose(filled.pressure, right.pressure, rtol=1e-3)
        self.assertIn("as lowest points", filled.account)
        for call in (lambda: rugosa.Target.like(masked, 0.01, fill=True, steps=4),
                     lambda: rugosa.design(like=masked, spacing=0.01, fill=True, pipeline="shape 2 | score")):
            with self.assertWarnsRegex(UserWarning, "filled points: at .* as lowest points"):
                call()
        with self.assertRaisesRegex(rugosa.InputError, "max.filled"):
            rugosa.contact(masked, 0.01, fill=True, max_filled=0.01)
        dead[10] = numpy.nan
        self.assertAlmostEqual(rugosa.Profile(dead, 0.01, fill=True).heights[10], (parabola[9] + parabola[11]) / 2, 15)


if __name__ == "__main__":
    unittest.main()
