#!/usr/bin/env bash
# shellcheck disable=SC2016 # Markdown has backquotes
# results.sh [NAME...]: runs the studies and writes docs/results from what came out: a page, its data and its plots for each of
#   defaults      problems that no deck was tuned for, with defaults only
#   a1            the pressurised cylinder of Guilkey et al. 2003, both couplings, floe's settings and the paper's
#   edges         edges of solids held by a penalty: stress beside surfaces that cut the mesh; other walls
#   sod           Sod's shock tube by cells and by points
#   shocks        Riemann problems, interfaces and blasts against exact solutions
#   bases         every basis with every transfer on manufactured solutions: orders, error against run time
#   waves         orders on smooth flow and on a vibrating bar
#   transport     viscosity, conduction, walls and open sides of the cells; the lid-driven cavity
#   conservation  what must stay as it is: free stream, closed box, column at rest
#   exchange      momentum, heat and mass between materials, slip
#   statics       loads that are solved for instead of stepped to; implicit steps of points
#   implicit      the implicit pressure beside the explicit step, at acoustic CFL of 10, 100, 1000
#   cpdi          domains of points that deform: CPDI beside the other bases
#   stability     the largest stable steps of a line of points, and other limits
#   extreme       scenes at the edge: right, refused or wrong
#   robustness    kills, faults, bad input, sanitizers, coverage: the totals of scripts/nightly.sh
#   contact       two bars that collide, with and without a contact; normals
#   normals       normals to unconnected points, and membranes with them
#   couplings     one deck, each coupling: error against run time, and which wins where
#   membrane-rest membranes that gas blows up, against their exact rest; an hour, unless its finest run is there
#   sealed        membranes that hold gas of the cells: at rest, in a stream, a piston, the circle and the dog-bone
#   axis          about an axis: solids in gas against Lamé, membranes that hold gas, blasts
#   interface     solids in gas by the smeared and by the sharp interface
#   substeps      sub-steps of the points in a step of the cells: a stiff ring, a shock on steel, how stiff and how heavy
#   membrane-3d   membranes as surfaces in space
#   ball-net      a ball thrown at a net
#   airbag        York's airbag hit by two cylinders
#   york-points   material points as York has them: gas, plasticity, axisymmetry, cell crossing
#   speed         rates of the solvers
#   cost_accuracy error against run time beside the linear-basis baseline: every variant on the cylinder, and five more rows; ten minutes
#   studies       the studies that stand in the decks: every coupling and basis, error against run time
#   picture       the pictures of the README
#   gallery       every deck with its picture
#   mutants       faults that the quick tests do not see: only when named, after scripts/mutants.py (hours)
# Each is made by scripts/results/NAME.py, or by NAME.bash where it is older. `results.sh stale [--strict]` lists the pages that no longer agree with
# sources, decks and scripts; with --strict it fails if there is any. `results.sh index` writes the index anew. Without a name: all, in some hours. The index, docs/results/README.md, lists every bar, met or missed.
set -euo pipefail
cd "$(dirname "$0")/.."

results=docs/results
bars=$results/bars.csv
floe=${FLOE:-build/release/floe}
build=$(dirname "$floe")
export OMP_NUM_THREADS=1 LC_ALL=C
# shellcheck source=scripts/lib/page.bash
. scripts/lib/page.bash
for file in scripts/results/*.bash; do
    # shellcheck source=/dev/null
    . "$file"
done

# The pages, in the order of the index.
all=(defaults a1 edges studies couplings sod shocks waves bases cpdi transport conservation exchange statics implicit stability extreme robustness contact normals axis membrane-3d membrane-rest sealed interface substeps ball-net airbag york-points speed cost_accuracy picture gallery)

write_index() {
    local page=$results/README.md file
    printf '# Results\n\n*Written by `scripts/results.sh`; do not edit.*\n\n' >"$page"
    write 'From runs that anyone can repeat: `scripts/results.sh`, or `scripts/results.sh NAME` for one page. Bars were set before anything' \
        'was measured.' '' '| page | |' '|---|---|'
    for file in "${all[@]}" mutants before york-membranes; do
        [ -f $results/$file.md ] && write "| [$file]($file.md) | $(sed -n '1s/^# //p' $results/$file.md) |"
    done
    [ -f "$bars" ] || return 0
    write '' 'The last line of a page names what it was made from: a hash of `include`, the CMake files and the modules of `src` that its runs entered' \
        '(cells alone: all but `mpm` and `surface`; points alone: all but `ice`; single runs: all but `study` and `batch`; `draw` and `report` only where floe drew its figures),' \
        'one of its decks, one of its script; comments and blanks do not count. `scripts/results.sh stale` lists the pages that no longer agree, and those' \
        'of before there were stamps (`scripts/results/unstamped.txt`). A page is made anew for its figures, and never to mark it.'
    write '' '| page | what | measured | bar | |' '|---|---|---|---|---|'
    for file in "${all[@]}"; do
        awk -v name=$file 'index($0, name ",\"") == 1 { rest = substr($0, length(name) + 3); q = index(rest, "\",")
            split(substr(rest, q + 2), f, ","); printf "| [%s](%s.md) | %s | %s | %s | %s |\n", name, name, substr(rest, 1, q - 1), f[1], f[2],
            f[3] == "met" ? "met" : "**missed**" }' "$bars" >>"$page"
    done
}

if [ "${1:-}" = stale ]; then
    FLOE_PAGES=$results exec /usr/bin/python3 scripts/lib/stamp.py "$@"
fi
if [ "${1:-}" = index ]; then
    write_index
    exit
fi
[ $# -gt 0 ] || set -- "${all[@]}"
for wanted in "$@"; do
    [[ " ${all[*]} mutants " == *" $wanted "* ]] || {
        echo "results.sh: unknown result '$wanted'; there are: ${all[*]}" >&2
        exit 2
    }
done
[ -x "$floe" ] || scripts/build.sh release
mkdir -p "$results" out/results
for wanted in "$@"; do
    echo "$wanted" >&2
    if [ -f "scripts/results/$wanted.py" ]; then
        FLOE=$floe /usr/bin/python3 scripts/lib/pages.py "$wanted"
    else
        name=
        "result_$wanted"
        [ -z "$name" ] || stamp_page
    fi
done
write_index
