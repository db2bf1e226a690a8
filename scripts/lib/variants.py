"""What a record of bits (scripts/same_bits.py record) runs beyond every deck in its couplings: settings that pages choose and decks may not, on a small
deck each, as (deck, coupling, settings); and commands that make tables of cases and pictures, as (command, deck, coupling, words)."""
LINE, PLANE, RING = "inputs/bar_mms.yaml", "inputs/ring_mms.yaml", "inputs/annulus_traction.yaml"
CYLINDER, TUBE, BARS, CIRCLE = "inputs/pressurized_cylinder.yaml", "inputs/sod.yaml", "inputs/two_bars.yaml", "inputs/membrane_circle.yaml"
BASES = ("linear", "gimp", "cpdi", "quadratic", "cubic")
TRANSFERS = ("flip", "pic", "xpic", "apic", "tpic", "afmpm")

VARIANTS = [
    *((deck, "mpm", [f"method.basis={basis}", f"method.transfer={transfer}", *(["method.flip=null"] if transfer != "flip" else [])])
      for deck in (LINE, PLANE) for basis in BASES for transfer in TRANSFERS),
    *((CYLINDER, coupling, [f"method.basis={basis}"]) for coupling in ("mpm", "ice-mpm") for basis in BASES),
    *((CYLINDER, coupling, [f"method.basis={basis}", f"method.edge_penalty={share}"]) for coupling in ("mpm", "ice-mpm") for basis, share in (("quadratic", 0.05), ("linear", 0))),
    *((deck, coupling, ["method=g03"]) for deck, coupling in ((CYLINDER, "mpm"), (CYLINDER, "ice-mpm"), (TUBE, "ice"), (RING, "mpm"))),
    *((CYLINDER, "ice-mpm", [f"method.interface={interface}"]) for interface in ("smeared", "sharp")),
    *((CYLINDER, "ice-mpm", [f"time.substeps={number}"]) for number in (1, 4)),
    *((CYLINDER, coupling, ["time.solver=auto"]) for coupling in ("mpm", "ice-mpm")),
    *((RING, "mpm", [f"method.basis={basis}", "time.solver=static"]) for basis in BASES),
    (RING, "mpm", ["time.solver=static", "time.increments=4"]),
    *((LINE, "mpm", [f"method.basis={basis}", "time.solver=implicit", "time.increments=8"]) for basis in BASES),
    *((deck, "mpm", [f"method.stress={when}"]) for deck in (LINE, PLANE) for when in ("usl", "usf", "musl")),
    *((deck, "mpm", [f"method.basis={basis}", "method.transfer=flip", "method.flip=1"]) for deck in (LINE, PLANE) for basis in BASES),
    *((PLANE, "mpm", [f"method.transfer={transfer}", "method.filter_order=3"]) for transfer in ("xpic", "afmpm")),
    *((TUBE, "mpm", [f"method.losses={losses}"]) for losses in ("drift", "own", "heat")),
    (PLANE, "mpm", ["method.basis=cpdi", "method.domain_limit=0.5"]),
    *((TUBE, "mpm", [f"method.point_density={way}"]) for way in ("continuity", "cell", "quadratic")),
    *((TUBE, "mpm", [f"method.basis={basis}"]) for basis in BASES if basis != "cpdi"),
    *((TUBE, "ice", [f"method.centring={centring}"]) for centring in ("half", "full")),
    *((TUBE, "ice", [f"method.limiter={limiter}"]) for limiter in ("none", "first_order")),
    (TUBE, "ice", ["method.energy=internal"]),
    (TUBE, "ice", ["method.volume_relaxation=0.5"]),
    *((TUBE, "ice", ["method.pressure=implicit", f"time.acoustic_cfl={cfl}"]) for cfl in (2, 100)),
    (TUBE, "ice", ["method.pressure=implicit", "method.pressure_tolerance=1e-6"]),
    *((TUBE, coupling, [f"time.{name}"]) for coupling in ("ice", "mpm") for name in ("cfl=0.2", "fixed_step=0.0005", "max_step=0.0005", "first_step=0.0001", "growth=1.5")),
    *((BARS, "mpm", [f"contact.criterion={criterion}", f"contact.touch={touch}"]) for criterion in ("pair", "mean", "both") for touch in ("points", "nodes")),
    (BARS, "mpm", ["contact.kind=friction", "contact.friction=0.3"]),
    (BARS, "mpm", ["contact.kind=stick", "contact.criterion=null", "contact.normals=null"]),
    *((BARS, "mpm", [f"contact.normals={normals}"]) for normals in ("colour", "mass")),
    *((CIRCLE, "mpm", [f"bodies.skin.membrane.normals={normals}"]) for normals in (
        "colour", "colour_cubic", "colour_quadratic", "connectivity", "isosurface", "isosurface_linear", "isosurface_quadratic", "quadric")),
    *((CIRCLE, "mpm", [f"bodies.skin.membrane.strain={strain}", "bodies.skin.membrane.smoothing=null"]) for strain in ("rate", "positions")),
    *((CIRCLE, coupling, ["time.solver=static"]) for coupling in ("mpm", "ice-mpm")),
]

COMMANDS = [ # each in one coupling, so that a page of another does not hang on it
    *(("compare", TUBE, coupling, ["--axis", "domain.cell=0.04,0.02", "--set", f"runs_as=[{coupling}]", "--set", f"coupling={coupling}", "--repeat", "0"]) for coupling in ("mpm", "ice")),
    *(("compare", "inputs/closed_box.yaml", coupling, ["--set", "time.max_steps=20", "--set", f"runs_as=[{coupling}]", "--set", f"coupling={coupling}", "--repeat", "0"])
      for coupling in ("mpm", "ice")),
    ("study", LINE, "mpm", ["--bases=linear,quadratic", "--axis", "domain.cell=0.25,0.125", "--repeat", "0"]),
    *(("study", TUBE, coupling, [f"--couplings={coupling}", "--axis", "domain.cell=0.1,0.05,0.025", "--set", "study=null", "--repeat", "0"]) for coupling in ("mpm", "ice")),
    ("stability", "inputs/stability_line.yaml", "mpm", ["--set", "time.max_steps=400", "--tolerance", "0.1"]),
    ("picture", CYLINDER, "ice-mpm", ["--coupling", "ice-mpm", "--set", "time.max_steps=4"]),
    ("picture", CYLINDER, "mpm", ["--coupling", "mpm", "--set", "time.max_steps=4"]),
    ("picture", TUBE, "ice", ["--coupling", "ice", "--set", "time.max_steps=4"]),
]
