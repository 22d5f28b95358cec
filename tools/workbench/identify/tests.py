# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests that plyform identify knows, with the options that a page asks for: as its --help has them."""


def number(name: str, words: str, unit: str = "", required: bool = False) -> dict:
    return {"name": name, "kind": "number", "words": words, "unit": unit, "required": required}


def fit(name: str, words: str, unit: str, numbers: bool = True) -> dict:
    """A number, or the word fit."""
    return {"name": name, "kind": "fit" if numbers else "only fit", "words": words, "unit": unit, "required": False}


def choice(name: str, words: str, choices: list[str], required: bool = False) -> dict:
    return {"name": name, "kind": "choice", "words": words, "unit": "", "required": required, "choices": choices}


def flag(name: str, words: str) -> dict:
    return {"name": name, "kind": "flag", "words": words, "unit": "", "required": False}


def text(name: str, words: str, required: bool = False) -> dict:
    return {"name": name, "kind": "text", "words": words, "unit": "", "required": required}


COLUMNS = [text("x-column", "column of the first quantity, by name or number; as the header says unless given"),
           text("x-unit", "its unit, if the header has none or a wrong one"),
           text("y-unit", "unit of the load, if the header has none or a wrong one")]
DOUBTFUL = flag("yes-doubtful", "go on though the curve is doubtful")


def corrections(of: str, unit: str, toe: str) -> list[dict]:
    return [number("from", f"{of} from which rows count", unit), number("to", f"{of} up to which rows count", unit),
            number("compliance", "by which machine, load cell and clamps give way; 0: none", "mm/N"),
            fit("zero", "load that the cell shows without a load", "N"),
            fit("toe", "extension at which the specimen is taut", toe),
            fit("slip", "a sudden slip in the clamps is taken off", "", numbers=False)]


SHEAR = [choice("law", "form of the law; chosen by cross-validation unless given", ["polynomial", "static", "table"]),
         number("coefficients", "of a polynomial: k1, k3 ..."), number("points", "of a table"),
         text("stitch", "of the fabric, by which the two kinds of specimens differ"),
         text("angle-column", "column of a measured shear angle; none: the extension counts"),
         text("speeds", "of the crosshead in each curve, mm/s, with commas between: a law with a viscous torque"),
         text("temperatures", "of each of them, °C, with commas between: viscosity over temperature"),
         choice("temperature-law", "form of that; chosen by the curves unless given", ["arrhenius", "wlf", "table"]),
         number("viscosity-coefficients", "c0, c2, c4, with speeds")]
YARNS = [number("yarns", "that share the force"),
         number("gauge-length", "if the curve has displacements instead of strains", "mm")]
RUBBER = [number("width", "of the section, for loads in N; its thickness is the fabric's", "mm"),
          number("gauge-length", "if the curve has displacements instead of strains or stretches", "mm")]
RUBBER_LAW = choice("law", "chosen by the rows unless given", ["neo_hookean", "mooney_rivlin"])
DIRECTION = choice("direction", "yarns that it is a test of", ["warp", "weft", "both"], required=True)


def test(word: str, title: str, gives: str, curve: str, sizes: list, more: list, others: tuple = ()) -> dict:
    """Of a test that changes a fabric."""
    return {"word": word, "title": title, "gives": gives, "curve": curve, "sizes": sizes, "fabric": True,
            "corrections": [*more, DOUBTFUL], "others": dict(zip(("name", "words"), others)) or None}


PULL_OUT = {
    "word": "pull-out", "title": "Pull-out", "gives": "law of friction between plies, or plies and tools, for a case",
    "curve": "displacement and load of a ply drawn from between two faces, a file a test",
    "sizes": [number("area", "of one face that is pulled; both slide", "mm2", True),
              text("speeds", "of each test, mm/s, with commas between, in the order of the curves", True),
              text("pressures", "of each test, N/mm2, likewise", True),
              text("viscosity", "of the matrix at the temperature of the test, Pa s: one number, or one a test", True)],
    "fabric": False, "others": None,
    "corrections": [number("from", "displacement from which the pull is steady", "mm"),
                    number("to", "displacement up to which it is", "mm"),
                    number("points", "of the curve, 2 to 8; chosen unless given"),
                    text("name", "of the law in a case: [friction.NAME]; pull_out unless given"), *COLUMNS]}


NEGATIVE = ("negative", "specimens cut, or frames turned, the other way: the angle opens")
TESTS = [
    test("frame", "Picture frame", "shear law",
         "extension of the diagonal and load, a file a specimen; or a normalised force in N/mm over the angle",
         [number("side", "from hinge to hinge; not needed for N/mm", "mm")],
         [*SHEAR, *corrections("shear angle", "°", "mm"), *COLUMNS], NEGATIVE),
    test("bias", "Bias extension", "shear law", "extension and load, a file a specimen",
         [number("length", "free, between the clamps", "mm", True), number("width", "", "mm", True)],
         [*SHEAR, *corrections("shear angle", "°", "mm"), *COLUMNS], NEGATIVE),
    test("warp", "Tension of warp yarns", "tension of one yarn", "strain or displacement, and load", YARNS,
         [*corrections("strain", "", "mm or strain"), *COLUMNS, number("weft-yarns", "of the weft specimens")],
         ("weft", "specimens of weft yarns, to compare with")),
    test("weft", "Tension of weft yarns", "tension of one yarn", "strain or displacement, and load", YARNS,
         [*corrections("strain", "", "mm or strain"), *COLUMNS]),
    test("biaxial", "Biaxial tension", "tension of straight yarns and crimp",
         "warp strain, weft strain, warp load, weft load; a file for each strain ratio",
         [number("warp-yarns", "that share the load"), number("weft-yarns", "that share the load")],
         [fit("toe", "wrong zeros of strain are taken off", "", numbers=False)]),
    test("uniaxial", "Uniaxial tension of rubber", "law of a sheet of rubber",
         "strain, stretch or displacement, and load or nominal stress", RUBBER,
         [RUBBER_LAW, *corrections("strain", "", "mm or strain"), *COLUMNS],
         ("equibiaxial", "specimens of the same rubber stretched both ways: one law of both")),
    test("equibiaxial", "Equibiaxial tension of rubber", "law of a sheet of rubber",
         "strain, stretch or displacement, and load or nominal stress", RUBBER,
         [RUBBER_LAW, *corrections("strain", "", "mm or strain"), *COLUMNS]),
    test("compression", "Compression of yarns", "compression_stiffness, buckling_force",
         "shortening and force of a strip held flat, both positive; one specimen", [*YARNS, DIRECTION],
         [*corrections("strain", "", "mm or strain"), *COLUMNS]),
    test("cantilever", "Cantilever", "bending_stiffness",
         "overhang, and angle of the chord or deflection of the tip; a row a reading",
         [choice("reading", "beside the overhang", ["angle", "deflection"]), DIRECTION], COLUMNS,
         ("weft", "specimens of weft yarns, to compare with")),
    test("three-point", "Three-point bending", "bending_stiffness or bending_table", "deflection and force",
         [number("span", "distance of the supports", "mm", True), number("width", "of the strip", "mm", True),
          DIRECTION], [*corrections("deflection over the span", "", "mm"), *COLUMNS]),
    test("relaxation", "Relaxation of shear", "Maxwell branches of shear",
         "time since the stop, and load; one test",
         [number("side", "of a frame: from hinge to hinge", "mm"), number("length", "of a bias test", "mm"),
          number("width", "of a bias test", "mm"), number("angle", "shear angle at the stop", "°", True),
          number("ramp", "time that it took to get there; 0: at once", "s")],
         [text("times", "relaxation times, s, with commas between; looked for unless given"), *COLUMNS]),
    test("in-plane-bending", "In-plane bending", "in_plane_bending_stiffness",
         "distance along a yarn and shear angle; a file a profile", [DIRECTION], COLUMNS),
    PULL_OUT]
