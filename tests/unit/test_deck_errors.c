/* Decks that must be refused: each at its line and column, in words that help. */
#include "unit/test_deck_common.h"

#include "scene/deck_location.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct fixture {
    context *ctx;
    catalogue_store store;
} fixture;

static int set_up(void **state)
{
    static fixture f;
    deck_init();
    f.ctx = context_create();
    make_catalogue(&f.store);
    *state = &f;
    return f.ctx ? 0 : -1;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    assert_int_equal(memory_read_account(f->ctx).live_bytes, 0);
    context_destroy(&f->ctx);
    return 0;
}

/* A sound deck, of which each case spoils one place. */
static const char sound[] =
    /*  1 */ "floe: 1\n"
             /*  2 */ "title: a test\n"
             /*  3 */ "coupling: mpm\n"
             /*  4 */ "runs_as: [mpm, ice-mpm]\n"
             /*  5 */ "domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.1}\n"
             /*  6 */ "materials:\n"
             /*  7 */ "  steel: {density: 8900, law: {linear_elastic: {bulk_modulus: 117 GPa, shear_modulus: 44 GPa}}, "
             "specific_heat: 460}\n"
             /*  8 */ "  gas: {eos: {ideal: {gamma: 1.4, specific_heat: 717}}}\n"
             /*  9 */ "ambient: {material: gas, pressure: 1e5, temperature: 300}\n"
             /* 10 */ "boundaries: {x: slip, y: {lower: symmetry, upper: {outlet: {pressure: 1e5}}}}\n"
             /* 11 */ "bodies:\n"
             /* 12 */ "  ring: {material: steel, shape: {annulus: {inner_radius: 0.5, outer_radius: 0.9}}}\n"
             /* 13 */ "  bore: {material: gas, shape: {ball: {radius: 0.5}}, pressure: 1e5, temperature: 300}\n"
             /* 14 */ "loads:\n"
             /* 15 */ "  heat: {pressurise: {material: gas, target: 1 MPa, ramp: 1 ms}}\n"
             /* 16 */ "  pull: {traction: {body: ring, surface: {ball: {radius: 0.5}}, pressure: 1 MPa}}\n"
             /* 17 */ "time: {end: 10 ms, cfl: 0.5}\n"
             /* 18 */ "stop: {window: 1 ms}\n"
             /* 19 */ "method: {basis: quadratic, stress: usl}\n"
             /* 20 */ "output: {interval: 1 ms, probes: {p: [0.1, 0.1]}}\n"
             /* 21 */ "verify: {exact: {uniform: {density: 1, pressure: 1}}, metrics: [l1_density]}\n"
             /* 22 */ "compare: {axis: {domain.cell: [0.1, 0.05]}}\n";

typedef struct spoiled {
    const char *old, *fresh; /* the first `old` of the sound deck becomes `fresh` */
    const char *place;       /* "5:48" */
    const char *words[3];    /* all of these must be in the report */
} spoiled;

/* Thirty levels each. */
#define OPEN "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["
#define CLOSE "]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]"

static const spoiled cases[] = {
    /* keys */
    {"title:", "titel:", "2:1", {"unknown key 'titel'", "(did you mean 'title'?)"}},
    {"density: 8900",
     "densty: 8900",
     "7:11",
     {"unknown key 'densty' (did you mean 'density'?)", "missing key 'density' in 'steel'"}},
    {"shear_modulus",
     "poisson_ratio",
     "7:49",
     {"'bulk_modulus' beside Young's modulus", "young_modulus and poisson_ratio"}},
    {"bulk_modulus: 117 GPa, shear_modulus: 44 GPa",
     "young_modulus: 117 GPa",
     "7:32",
     {"missing key 'poisson_ratio' in 'linear_elastic'", "give young_modulus and poisson_ratio"}},
    {"bulk_modulus: 117 GPa, shear_modulus: 44 GPa",
     "young_modulus: 117 GPa, poisson_ratio: 0.5",
     "7:88",
     {"poisson_ratio"}},
    /* words of others, keys of other places, and slips of writing */
    {"ball: {radius: 0.5}}, pre", "circle: {radius: 0.5}}, pre", "13:33", {"did you mean 'ball'?"}},
    {"ball: {radius: 0.5}}, pre",
     "cylinder: {center: [0, 0], radius: 0.5}}, pre",
     "13:33",
     {"it is of scenes in space; in the plane `ball`"}},
    {"x: slip", "x: {left: slip}", "10:18", {"did you mean 'lower'?"}},
    {"coupling: mpm", "coupling: MPM", "3:11", {"unknown coupling 'MPM' (did you mean 'mpm'?)"}},
    {"{outlet: {pressure: 1e5}}", "{outlet: 1 atm}", "10:60", {"not a map", "expected: a map: {pressure: value, ...}"}},
    {"{ball: {radius: 0.5}}, pre", "{ball: 0.5}, pre", "13:39", {"not a map", "expected: {radius: value, ...}"}},
    {"x: slip", "x: fixed", "10:17", {"did you mean 'no_slip'?"}},
    {"stop: {", "gravity: [0, 1]\nstop: {", "18:1", {"did you mean 'loads'?", "acceleration"}},
    {"time: {end", "time: {dt: 1e-6, end", "17:8", {"did you mean 'fixed_step'?"}},
    {"stop: {", "cfl: 0.5\nstop: {", "18:1", {"'cfl' is a key of time"}},
    {"stop: {", "traction: {}\nstop: {", "18:1", {"'traction' is a key of loads.NAME"}},
    {"time: {end", "time: {points: 2, end", "17:8", {"'points' is a key of ambient, bodies.NAME"}},
    {"end: 10 ms", "end: 1,5 ms", "17:15", {"write decimals with a point"}},
    {"ball: {radius: 0.5}}, pre", "ball: {radius: 0,5}}, pre", "13:50", {"write decimals with a point"}},
    {"upper: [1, 1]", "upper: [0,3, 0,3]", "5:40", {"'upper' is a list of 4", "written with a point"}},
    {"cell: 0.1", "cell:0.1", "5:48", {"with a space behind the colon"}},
    {"cell: 0.1", "cell = 0.1", "5:48", {"with a space behind the colon"}},
    {"8900", "8900 MPA", "7:20", {"unit 'MPA' is not known (did you mean 'MPa'?)"}},
    {"temperature: 300}", "temperature: 20 C}", "9:54", {"(did you mean 'degC'?)"}},
    {"bodies:", "\tbodies:", "11:1", {"tab", "indent with spaces"}},
    {"bodies:", "bodies", "11:1", {"write `key: value`"}},
    {"x: slip", "x: lower: slip", "10:22", {"braces of its own"}},
    {"[0, 0]", "[0, 0", "5:56", {"a [ before this } is not closed"}},
    {"stop: {window: 1 ms}",
     "springs: {s: {from: {place: [0, 0]}, to: {body: ring, point: 1}, stiffness: 1}}",
     "18:22",
     {"'place' is now called 'position'", "expected: position"}},
    {"title: a test", "title: a\ntitle: b", "3:1", {"duplicate key 'title' (first at line 2, column 1)"}},
    {"cell: 0.1}", "cell: 0.1, cell: 0.2}", "5:59", {"duplicate key 'cell' (first at line 5, column 48)"}},
    {"  gas: {eos", "  steel: {eos", "8:3", {"duplicate material 'steel' (first at line 7, column 3)"}},
    {", cell: 0.1", "", "5:1", {"missing key 'cell' in 'domain'", "expected: cell: one for all axes"}},
    {"floe: 1\n", "", "1:1", {"missing key 'floe' in the deck", "version of the deck format: 1"}},
    {"floe: 1", "floe: 2", "1:7", {"this floe reads version 1"}},
    {"cell: 0.1", "cell:", "5:48", {"'cell' has no value"}},
    {"end: 10 ms, ", "", "17:1", {"missing key 'end' in 'time'"}},
    /* types */
    {"domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.1}", "domain: 2", "5:9", {"'domain' is '2', not a map"}},
    {"[0, 0]", "{x: 0}", "5:25", {"'lower' is a map", "expected: a list of 2"}},
    {"[1, 1]", "[1, 1, 1]", "5:40", {"'upper' is a list of 3", "a list of 2"}},
    {"cell: 0.1", "cell: fine", "5:54", {"'fine' is not a number", "expected: one for all axes"}},
    {"dim: 2", "dim: 2.5", "5:15", {"'2.5' is not a whole number", "a whole number from 1 to 3"}},
    {"stop: {window: 1 ms}",
     "contact: {between: ring}",
     "18:20",
     {"'between' is 'ring'", "all, or a list of two bodies"}},
    {"stop: {window: 1 ms}",
     "contact: {between: [ring, rong]}",
     "18:27",
     {"unknown body 'rong' (did you mean 'ring'?)"}},
    {"stop: {window: 1 ms}", "contact: {between: [ring, ring]}", "18:27", {"body 'ring' is listed twice"}},
    {"stop: {window: 1 ms}", "contact: {friction: 0.3}", "18:11", {"'friction' belongs to kind friction"}},
    {"stop: {window: 1 ms}", "contact: {normals: color}", "18:20", {"unknown kind of normals 'color'"}},
    {"  bore: {material: gas, shape: {ball: {radius: 0.5}}, pressure: 1e5, temperature: 300}\n",
     "  core: {material: steel, shape: {ball: {radius: 0.5}}}\ncontact: {kind: friction}\n",
     "12:20",
     {"bodies 'ring' and 'core' are of one material", "under another name"}},
    {"runs_as: [mpm, ice-mpm]",
     "contact: {kind: stick}",
     "4:1",
     {"there is nothing to touch", "two solid bodies or more"}},
    {"runs_as: [mpm, ice-mpm]", "contact: {between: [ring, bore]}", "4:20", {"body 'bore' is a fluid"}},
    {"ramp: 1 ms", "hold: yes", "15:59", {"'hold' is 'yes'", "expected: true or false"}},
    {"basis: quadratic", "basis: [quadratic]", "19:17", {"unknown basis"}},
    {"basis: quadratic", "losses: heat, flip: 0", "19:30", {"points with flip 0 forget what they lose"}},
    {"[mpm, ice-mpm]", "mpm", "4:10", {"'runs_as' is 'mpm'", "a list of mpm, ice, ice-mpm"}},
    {"{p: [0.1, 0.1]}", "[0.1, 0.1]", "20:34", {"'probes' is a list of 2, not a map of names"}},
    /* numbers */
    {"1e5, temperature: 300}\n", "0x10, temperature: 300}\n", "9:36", {"'0x10' is not a decimal number"}},
    {"8900", "0644", "7:20", {"'0644' starts with a zero"}},
    {"8900", "89_00", "7:20", {"'89_00' goes on after the number"}},
    {"8900", "8900 2 kg/m3", "7:20", {"'8900 2 kg/m3' goes on after the number"}},
    {"8900", "8900kg", "7:20", {"has no space between number and unit"}},
    {"8900", ".inf", "7:20", {"'.inf' is not a finite number"}},
    {"8900", "-.NaN", "7:20", {"is not a finite number"}},
    {"8900", "1e999", "7:20", {"too large for a double"}},
    {"8900", "-1", "7:20", {"-1 is out of range", "expected: a number > 0 in kg/m3"}},
    {"117 GPa", "117 GHz", "7:63", {"unit 'GHz' does not fit: it does not convert to Pa"}},
    {"117 GPa", "117 furlongs_per_second", "7:63", {"unit 'furlongs_per_second' is not known"}},
    {"117 GPa", "1e305 GPa", "7:63", {"too large"}},
    {"gamma: 1.4", "gamma: 1.4 m", "8:30", {"unit 'm' does not fit: the number has no dimension"}},
    {"gamma: 1.4", "gamma: 0.9", "8:30", {"0.9 is out of range", "a number from"}},
    {"title: a test", "units: none", "7:63", {"unit 'GPa' in a deck with 'units: none'"}},
    {"cfl: 0.5", "cfl: 1.5", "17:25", {"1.5 is out of range"}},
    /* names */
    {"coupling: mpm", "coupling: ice_mpm", "3:11", {"unknown coupling 'ice_mpm' (did you mean 'ice-mpm'?)"}},
    {"material: steel",
     "material: stele",
     "12:20",
     {"unknown material 'stele' (did you mean 'steel'?)", "expected: steel, gas"}},
    {"annulus", "anulus", "12:35", {"unknown shape 'anulus' (did you mean 'annulus'?)"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{union: [{ball: {radius: 0.5}}, {bal: {radius: 1}}]}",
     "12:67",
     {"unknown shape 'bal' (did you mean 'ball'?)"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{union: [{ball: {radius: 0.5}}, {ball: {radius: -1}}]}",
     "12:82",
     {"'radius': -1 is out of range"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{union: {ball: {radius: 0.5}}}",
     "12:42",
     {"'union' is a map, not a list", "a list of 1 or more, each {name: {parameters}} of one shape"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{union: []}",
     "12:42",
     {"'union' has 0 entries, of 1 or more"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}", "union", "12:34", {"'union' has no value"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{difference: {of: {box: {lower: 0, upper: 1}}, without: [{ball: {radius: 1}}]}}",
     "12:66",
     {"'lower' is '0'"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{difference: {of: {ball: {radius: 1}}}}",
     "12:35",
     {"missing key 'without' in 'difference'"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{difference: {of: {ball: {radius: 1}}, without: [{ball: {radius: 1}, box: {}}]}}",
     "12:103",
     {"has 2 entries, one shape is needed"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{difference: {of: {ball: {radius: 1}}, without: [{}]}}",
     "12:83",
     {"no entry, where one shape is needed"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{polygon: {vertices: [[0, 0], [1, 1], [1, 0], [0, 1]]}}",
     "12:35",
     {"meets side 3, from (1, 0) to (0, 1), at (0.5, 0.5)"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{polygon: {vertices: [[0, 0], [1, 1]]}}",
     "12:55",
     {"'vertices' is a list of 2", "a list of 3 or more positions, [[x, y], [x, y], ...]"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{polygon: {vertices: [[0, 0], [1, 1, 2], [0, 1]]}}",
     "12:64",
     {"this is no place of the scene"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{polygon: {vertices: [[0, 0], [1, 1], [0, 1 kg]]}}",
     "12:76",
     {"'vertices'"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{moved: {of: {ball: {radius: 1}}, axis: [0, 1]}}",
     "12:35",
     {"'axis' is of scenes in space"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{moved: {of: {ball: {radius: 1}}, turned: 3 m}}",
     "12:76",
     {"'turned'"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{intersection: [{ball: {radius: 0.1}}, {ball: {centre: [1, 1], radius: 0.2}}]}",
     "12:35",
     {"its shapes have nothing in common"}},
    {"{annulus: {inner_radius: 0.5, outer_radius: 0.9}}",
     "{moved: {of: {extruded: {of: {ball: {radius: 1}}, from: 0, to: 1}}}}",
     "12:48",
     {"it is of scenes in space; in the plane take its section"}},
    {"linear_elastic", "hookean", "7:32", {"unknown law 'hookean' (did you mean 'linear_elastic'?)"}},
    {"linear_elastic", "dough", "7:32", {"unknown law 'dough'", "linear_elastic, mooney_rivlin"}},
    {"ideal", "idael", "8:15", {"unknown equation of state 'idael' (did you mean 'ideal'?)"}},
    {"slip", "sleep", "10:17", {"unknown boundary condition 'sleep'"}},
    {"outlet", "outlett", "10:52", {"unknown boundary condition 'outlett' (did you mean 'outlet'?)"}},
    {"{x: slip", "{z: slip", "10:14", {"unknown axis 'z'", "expected: x, y"}},
    {"lower: symmetry", "lowr: symmetry", "10:27", {"unknown side 'lowr' (did you mean 'lower'?)"}},
    {"pressurise", "presurise", "15:10", {"unknown load 'presurise' (did you mean 'pressurise'?)"}},
    {"body: ring", "body: rign", "16:27", {"unknown body 'rign' (did you mean 'ring'?)"}},
    {"quadratic", "quadratc", "19:17", {"unknown basis 'quadratc' (did you mean 'quadratic'?)"}},
    {"stress: usl", "stress: ulf", "19:36", {"unknown stress 'ulf' (did you mean 'us"}},
    {"uniform", "unifrm", "21:18", {"unknown exact solution 'unifrm' (did you mean 'uniform'?)"}},
    {"l1_density", "l1_densty", "21:65", {"unknown metric 'l1_densty' (did you mean 'l1_density'?)"}},
    {"[l1_density]", "[eq13]", "21:65", {"metric 'eq13': needs verify.pressure"}},
    {"[l1_density]", "[l1_density, l1_density]", "21:77", {"metric 'l1_density' is listed twice"}},
    {"  ring:", "  9ring:", "12:3", {"'9ring' cannot be the name of a body"}},
    {"[mpm, ice-mpm]", "[mpm, mpm]", "4:16", {"coupling 'mpm' is listed twice"}},
    /* models and variants */
    {"{ball: {radius: 0.5}}, pressure: 1e5",
     "{ball: {radius: 0.5}, box: {lower: 0}}, pressure: 1e5",
     "13:54",
     {"'shape' has 2 entries, one shape is needed"}},
    {"ball: {radius: 0.5}}, pressure: 1e5", "ball: }, pressure: 1e5", "13:33", {"missing key 'radius' in 'ball'"}},
    {"shape: {ball: {radius: 0.5}}, pressure: 1e5",
     "shape: ball, pressure: 1e5",
     "13:32",
     {"missing key 'radius' in 'ball'"}},
    {"outlet: {pressure: 1e5}", "outlet: {}", "10:52", {"missing key 'pressure' in 'outlet'"}},
    {"eos: {ideal",
     "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}, density: 1, eos: {ideal",
     "8:9",
     {"'law' belongs to solids"}},
    {"eos: {ideal: {gamma: 1.4, specific_heat: 717}}",
     "viscosity: {}",
     "8:3",
     {"material 'gas' has neither 'law' nor 'eos'"}},
    {"shape: {annulus", "pressure: 1, shape: {annulus", "12:27", {"'pressure' belongs to bodies made of a fluid"}},
    /* what no single key shows */
    {"cell: 0.1", "cell: 0.3", "5:54", {"not a whole number"}},
    {"upper: [1, 1]", "upper: [1, -1]", "5:40", {"the domain is empty along y"}},
    {"inner_radius: 0.5", "inner_radius: 0.95", "12:35", {"shape 'annulus'", "inner_radius"}},
    {"dim: 2,", "dim: 3, geometry: axisymmetric,", NULL, {"error"}},
    {"dim: 2,", "stress_state: uniaxial_strain,", "5:24", {"'uniaxial_strain' is a state of 1-D scenes"}},
    {"ambient: {material: gas, pressure: 1e5, temperature: 300}\n",
     "",
     "4:16",
     {"'ice-mpm' needs to know what surrounds the bodies"}},
    {"ambient: {material: gas", "ambient: {material: steel", "9:21", {"'steel' is a solid"}},
    {"[mpm, ice-mpm]", "[mpm, ice]", "4:16", {"'ice' has no solids, and body 'ring' is one"}},
    {"[mpm, ice-mpm]", "[ice-mpm]", "3:11", {"'runs_as' does not list 'mpm'"}},
    {", specific_heat: 460", "", "7:3", {"'ice-mpm' needs the specific heat of solid 'steel'"}},
    {"x: slip", "x: {lower: periodic}", "10:25", {"one side of x is periodic, the other is not"}},
    {", pressure: 1e5, temperature: 300}\nloads",
     "}\nloads",
     "13:3",
     {"fluid body 'bore' has no state", "two of pressure, temperature, density"}},
    {", pressure: 1e5, temperature: 300}\nloads",
     ", pressure: 1e5, temperature: 300, density: 1}\nloads",
     "13:3",
     {"has pressure, temperature and density"}},
    {"pressure: 1e5, temperature: 300}\nloads",
     "pressure: -1e5, temperature: 300}\nloads",
     "13:65",
     {"'gas' does not exist at -100000 Pa"}},
    {"ball: {radius: 0.5}}, pressure",
     "ball: {centre: [7, 7], radius: 0.5}}, pressure",
     "13:25",
     {"body 'bore' lies outside the domain"}},
    {"pressurise: {material: gas", "pressurise: {material: steel", "15:33", {"'steel' is a solid"}},
    {"traction: {body: ring", "traction: {body: bore", "16:27", {"'bore' is a fluid: a traction acts on solids"}},
    {"ramp: 1 ms", "ramp: 1 ms, ramp_steps: 5", "15:77", {"the ramp is given as a time and as a number of steps"}},
    {"cfl: 0.5", "first_step: 2, max_step: 1", "17:32", {"the first step (2 s) is above max_step (1 s)"}},
    {"stop:", "damping: {start: 2, end: 1}\nstop:", "18:26", {"damping ends (1 s) before it starts (2 s)"}},
    {"compare: {axis: {domain.cell: [0.1, 0.05]}}\n",
     "stability: {over: {time.cfl: [0.1, 0.2, 0.3]}}\n",
     "22:30",
     {"the range of 'time.cfl' has 3 values", "two keys with lists of values, for a map"}},
    {"compare: {axis: {domain.cell: [0.1, 0.05]}}\n",
     "stability: {over: {time.cfl: [0.1, 1.2]}}\n",
     "22:36",
     {"with time.cfl=1.2:"}},
    {"compare: {axis: {domain.cell: [0.1, 0.05]}}\n",
     "stability: {over: {time.clf: [0.1, 0.2]}}\n",
     "22:31",
     {"unknown key 'clf' (did you mean 'cfl'?)"}},
    {"compare: {axis: {domain.cell: [0.1, 0.05]}}\n",
     "stability: {each: {method.stress: [usl, usm]}}\n",
     "22:41",
     {"with method.stress=usm:"}},
    {"compare: {axis: {domain.cell: [0.1, 0.05]}}\n",
     "stability: {over: {time.cfl: [0.1], time.end: [1], method.flip: [1]}}\n",
     "22:19",
     {"more than 2 axes"}},
    {"compare: {axis: {domain.cell: [0.1, 0.05]}}\n", "stability: {growth: 0.5}\n", "22:21", {"0.5 is out of range"}},
    {"cell: 0.1}",
     "cell: 0.1, lattice_offset: 0.25}",
     "12:3",
     {"'domain.lattice_offset' moves lattices, and the points of body 'ring' fill its shape", "seeding: lattice"}},
    {"cell: 0.1}", "cell: 0.1, lattice_offset: [0, 0.6]}", "5:79", {"0.6 is out of range"}},
    {"p: [0.1, 0.1]", "p: [0.1, 3]", "20:38", {"probe 'p' lies outside the domain"}},
    {"{uniform: {density: 1, pressure: 1}}",
     "{lame: {inner_radius: 2, outer_radius: 1, inner_pressure: 1, bulk_modulus: 1, shear_modulus: 1}}",
     "21:56",
     {"verify.exact.lame.outer_radius: 1 m: must be over inner_radius = 2 m"}},
    {"[0.1, 0.05]", "[0.1, 0.07]", "22:37", {"with domain.cell=0.07", "not a whole number"}},
    {"domain.cell: [", "domain.sell: [", "22:32", {"with domain.sell=0.1: unknown key 'sell'"}},
    /* YAML itself */
    {"{dim: 2", "{dim: 2, [", NULL, {"error"}},
    {"title: a test", "title: \"a", NULL, {"error"}},
    {"title: a test", "title: \xff", "2:8", {"the byte 0xff stands where a character should"}},
    {"title: a test", "title: f\xc3\xbcr \xc3", "2:12", {"the byte 0xc3 stands where a character should"}},
    {"title: a test", "title: \xed\xa0\x80", "2:8", {"the byte 0xed stands where"}},
    {"title: a test", "title: \xc0\x80", "2:8", {"the byte 0xc0 stands where"}},
    {"title: a test", "title: \xe0\x80\x80", "2:8", {"the byte 0xe0 stands where"}},
    {"title: a test", "title: a\001b", "2:9", {"the byte 0x01 stands where"}},
    {"title: a test", "title: *a", "2:8", {"aliases (*) are not used"}},
    {"title: a test", "title: &a b", NULL, {"anchors (&) and tags (!) are not used"}},
    {"title: a test", "title: !!str b", NULL, {"anchors (&) and tags (!) are not used"}},
    {"time:", "---\ntime:", NULL, {"a second document begins here"}},
    {"title: a test", "? [a]\n: b", "2:3", {"a key of a map must be a name"}},
    {"title: a test", "title: " OPEN OPEN OPEN OPEN "1" CLOSE CLOSE CLOSE CLOSE, NULL, {"nested too deeply"}},
};

static char *spoil(const spoiled *c, char *text, size_t size)
{
    const char *at = strstr(sound, c->old);
    if (!at) {
        print_error("the sound deck has no '%s'\n", c->old);
        return NULL;
    }
    snprintf(text, size, "%.*s%s%s", (int)(at - sound), sound, c->fresh, at + strlen(c->old));
    return text;
}

static floe_status load(fixture *f, const char *text, const deck_overrides *set, deck_report *report)
{
    scene *s;
    FILE *file = fopen("deck.yaml", "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    const floe_status status = deck_check(&s, f->ctx, "deck.yaml", set, &f->store.catalogue, report);
    scene_destroy(&s);
    context_clear(f->ctx);
    return status;
}

static void sound_deck_loads(void **state)
{
    fixture *f = *state;
    deck_report report;
    const floe_status status = load(f, sound, NULL, &report);
    if (report.text) print_error("%s", report.text);
    check_ok(f->ctx, status);
    deck_report_free(&report);
}

/* "" if the report is as it should be, else what is missing. */
static const char *missing(const spoiled *c, const char *text)
{
    static char place[64];
    if (c->place) {
        snprintf(place, sizeof place, "deck.yaml:%s: error: ", c->place);
        if (!strstr(text, place)) return place;
    }
    for (size_t i = 0; i < 3 && c->words[i]; i++) {
        if (!strstr(text, c->words[i])) return c->words[i];
    }
    return "";
}

static void each_error_is_named_at_its_place(void **state)
{
    fixture *f = *state;
    int wrong = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[4096];
        deck_report report;
        assert_non_null(spoil(&cases[i], text, sizeof text));
        const floe_status status = load(f, text, NULL, &report);
        const char *lost = report.text ? missing(&cases[i], report.text) : "a report";
        if (status != FLOE_BAD_INPUT || lost[0]) {
            print_error("'%s' -> '%s': status %s, without \"%s\" in:\n%s\n", cases[i].old, cases[i].fresh,
                        status_name(status), lost, report.text ? report.text : "(nothing)");
            wrong++;
        }
        deck_report_free(&report);
    }
    assert_int_equal(wrong, 0);
}

static void all_errors_come_at_once_and_in_order(void **state)
{
    fixture *f = *state;
    static const char text[] = "floe: 1\n"
                               "coupling: mpn\n"
                               "domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: -1}\n"
                               "materials: {m: {law: {linear_elastic: {bulk_modulus: 1, shear: 1}}, density: 3 s}}\n"
                               "bodies: {b: {material: n, shape: {disc: {radius: 1}}}}\n"
                               "tyme: {end: 1}\n";
    static const char *const places[] = {
        "1:1: ", "2:11: ", "3:54: ", "4:23: ", "4:57: ", "4:78: ", "5:24: ", "5:35: ", "6:1: "};
    deck_report report;
    assert_int_equal(load(f, text, NULL, &report), FLOE_BAD_INPUT);
    assert_int_equal(report.count, sizeof places / sizeof places[0]);
    const char *at = report.text;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        char place[64];
        snprintf(place, sizeof place, "deck.yaml:%serror: ", places[i]);
        const char *found = strstr(at, place);
        if (!found) print_error("no %s in order in:\n%s", place, report.text);
        assert_non_null(found);
        at = found + 1;
    }
    deck_report_free(&report);
}

static void caret_stands_under_the_column(void **state)
{
    fixture *f = *state;
    char text[4096];
    deck_report report;
    const spoiled c = {"title: a test", "title: {\xC3\xA4\xC3\xB6: 1, b: 2}", NULL, {NULL}};
    assert_non_null(spoil(&c, text, sizeof text));
    assert_int_equal(load(f, text, NULL, &report), FLOE_BAD_INPUT);
    assert_non_null(strstr(report.text, "deck.yaml:2:8: error: 'title' is a map\n"
                                        "     2 | title: {\xC3\xA4\xC3\xB6: 1, b: 2}\n"
                                        "       |        ^\n"
                                        "         expected: text of at most 255 bytes\n"));
    deck_report_free(&report);

    const spoiled wide = {"coupling: mpm", "coupling:   \"\xC3\xA4\xC3\xB6\"", NULL, {NULL}};
    assert_non_null(spoil(&wide, text, sizeof text));
    assert_int_equal(load(f, text, NULL, &report), FLOE_BAD_INPUT);
    assert_non_null(strstr(report.text, "deck.yaml:3:13: "));
    deck_report_free(&report);
}

typedef struct bad_override {
    const char *assignment;
    const char *words;
} bad_override;

static void overrides_are_named_as_the_user_wrote_them(void **state)
{
    fixture *f = *state;
    static const bad_override overrides[] = {
        {"domain.cel=0.1", "--set domain.cel=0.1: error: unknown key 'cel' (did you mean 'cell'?)"},
        {"domain.cell=fine", "--set domain.cell=fine: error: 'cell': 'fine' is not a number"},
        {"domain.cell=0.3", "--set domain.cell=0.3: error: "},
        {"domain.cell", "--set domain.cell: error: this is no key with a value"},
        {"=3", "--set =3: error: this is no key with a value"},
        {"domain.upper.2=1", "--set domain.upper.2=1: error: '2' is no entry of a list of 2"},
        {"domain.upper.x=1", "'x' is no entry of a list of 2"},
        {"time.end.x=1", "--set time.end.x=1: error: 'end' is a value: it has no 'x'"},
        {"domain..cell=1", "--set domain..cell=1: error: 'domain..cell' has an empty part"},
        {"domain.upper=[1, 2", "--set domain.upper=[1, 2: error: the value is not YAML"},
        {"materials.copper.density=1",
         "--set materials.copper.density=1: error: material 'copper' has neither 'law' nor 'eos'"},
        {"metod.basis=null", "--set metod.basis=null: error: unknown key 'metod' (did you mean 'method'?)"},
        {"domain.cel=null", "--set domain.cel=null: error: unknown key 'cel' (did you mean 'cell'?)"},
        {"materials.stel=null", "--set materials.stel=null: error: unknown material 'stel'"},
        {"stress=usl", "--set stress=usl: error: unknown key 'stress'"},
    };
    for (size_t i = 0; i < sizeof overrides / sizeof overrides[0]; i++) {
        deck_report report;
        const deck_overrides set = {&overrides[i].assignment, 1};
        assert_int_equal(load(f, sound, &set, &report), FLOE_BAD_INPUT);
        if (!strstr(report.text, overrides[i].words)) print_error("no \"%s\" in:\n%s", overrides[i].words, report.text);
        assert_non_null(strstr(report.text, overrides[i].words));
        deck_report_free(&report);
    }
}

/* What is refused once the deck has been read has the place of its key, or of the nearest that is there; or is told as it is. */
static void what_a_run_refuses_has_its_place(void **state)
{
    fixture *f = *state;
    const struct {
        const char *const *key;
        const char *told;
    } refused[] = {
        {KEY("method", "stress"), "deck.yaml:19:36: method.stress: why"},
        {KEY("bodies", "ring"), "deck.yaml:12:3: bodies.ring: why"},
        {KEY("bodies", "ring", "shape", "annulus"), "deck.yaml:12:35: bodies.ring.shape.annulus: why"},
        {KEY("loads", "heat", "pressurise", "region"), "deck.yaml:15:10: loads.heat.pressurise.region: why"},
        {KEY("time", "substeps"), "deck.yaml:17:1: time.substeps: why"},
        {KEY("domain", "cell"), "--set domain.cell=0.05: why"},
        {KEY("domain", "dim"), "deck.yaml:5:15: domain.dim: why"},
        {KEY("damping", "end"), "--set damping={rate: 1}: damping.end: why"},
        {KEY("output", "interval"), "--set output=null: output.interval: why"},
        {KEY("nothing", "of", "it"), "nothing.of.it: why"},
    };
    const char *assignments[] = {"output=null", "domain.cell=0.05", "damping={rate: 1}"};
    const deck_overrides set = {assignments, 3};
    deck_report report;
    scene *s;
    check_ok(f->ctx, deck_load_text(&s, f->ctx, "deck.yaml", sound, strlen(sound), &set, &f->store.catalogue, &report));
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        assert_int_equal(scene_deck_location(s, fail_key(f->ctx, refused[i].key, "why")), FLOE_BAD_INPUT);
        assert_string_equal(context_message(f->ctx), refused[i].told);
        assert_int_equal(scene_deck_location(s, FLOE_BAD_INPUT), FLOE_BAD_INPUT);
        assert_string_equal(context_message(f->ctx), refused[i].told);
        context_clear(f->ctx);
    }
    assert_int_equal(scene_deck_location(s, FLOE_OK), FLOE_OK);
    deck_report_free(&report);
    scene_destroy(&s);
}

static void empty_and_strange_texts_are_refused(void **state)
{
    fixture *f = *state;
    static const char *const texts[] = {"",      "\n\n",     "# nothing\n", "3\n", "[1, 2]\n",
                                        "---\n", "\xFF\xFE", "a: b: c\n",   "{",   "%YAML 9.9\n---\na: 1\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        deck_report report;
        assert_int_equal(load(f, texts[i], NULL, &report), FLOE_BAD_INPUT);
        assert_non_null(report.text);
        assert_non_null(strstr(report.text, "deck.yaml:"));
        deck_report_free(&report);
    }
}

static void too_many_entries_are_refused(void **state)
{
    fixture *f = *state;
    char text[8192];
    size_t length = 0;
    deck_report report;
    length += (size_t)snprintf(text, sizeof text, "floe: 1\nmaterials:\n");
    for (int i = 0; i < 13; i++) {
        length +=
            (size_t)snprintf(text + length, sizeof text - length, "  m%d: {eos: {ideal: {specific_heat: 1}}}\n", i);
    }
    assert_int_equal(load(f, text, NULL, &report), FLOE_BAD_INPUT);
    assert_non_null(strstr(report.text, "deck.yaml:15:3: error: too many entries in 'materials': at most 12"));
    deck_report_free(&report);
}

static void unreadable_file_says_why(void **state)
{
    fixture *f = *state;
    deck_report report;
    scene *s;
    check_fails(f->ctx, deck_load(&s, f->ctx, "/nowhere/deck.yaml", NULL, &f->store.catalogue, &report), FLOE_IO);
    check_fails(f->ctx, deck_load(&s, f->ctx, "/", NULL, &f->store.catalogue, &report), FLOE_IO);
    assert_null(s);
    deck_report_free(&report);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(sound_deck_loads, set_up, tear_down),
        cmocka_unit_test_setup_teardown(each_error_is_named_at_its_place, set_up, tear_down),
        cmocka_unit_test_setup_teardown(all_errors_come_at_once_and_in_order, set_up, tear_down),
        cmocka_unit_test_setup_teardown(caret_stands_under_the_column, set_up, tear_down),
        cmocka_unit_test_setup_teardown(overrides_are_named_as_the_user_wrote_them, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_a_run_refuses_has_its_place, set_up, tear_down),
        cmocka_unit_test_setup_teardown(empty_and_strange_texts_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(too_many_entries_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(unreadable_file_says_why, set_up, tear_down),
    };
    /* Decks are read from the file deck.yaml, in a folder of this test. */
    char folder[] = "/tmp/deck_errors-XXXXXX";
    if (!mkdtemp(folder) || chdir(folder) != 0) return 1;
    const int failed = cmocka_run_group_tests_name("deck_errors", tests, NULL, NULL);
    (void)remove("deck.yaml");
    (void)rmdir(folder);
    return failed;
}
