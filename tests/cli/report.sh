#!/usr/bin/env bash
# floe report: one page that holds all it shows, of any folders, whatever they lack; and how it stands in a browser.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
python_is_whole || {
    echo 'skipped: no Python with numpy, h5py, matplotlib and jinja2'
    exit 77
}

# whole_page FILE: well-formed, nothing from outside, every name once, every link to a place that is there, no empty data, every figure drawn; under 2 MB.
whole_page() {
    local page=$1 ids figures
    is_there "$page"
    if command -v xmllint >/dev/null; then
        xmllint --noout "$page" 2>stderr || fault "$page is not well-formed"
    fi
    ! grep -qE "(src|href|url\()[=\"']*(https?:)?//" "$page" || fault "$page takes something from outside"
    ! grep -qE '<(script [^>]*|link|iframe|object)[ />]' "$page" || fault "$page has more than markup and its own script"
    [ "$(wc -c <"$page")" -lt 2000000 ] || fault "$page is as large as $(wc -c <"$page") bytes"
    grep -oE " id=[\"'][^\"']*[\"']" "$page" | tr -d "\"'" | sed 's/ id=//' >ids
    ids=$(sort ids | uniq -d)
    [ -z "$ids" ] || fault "names that stand twice in $page: $ids"
    grep -oE "href=[\"']#[^\"']*" "$page" | sed -E "s/href=[\"']#//" | sort -u >links
    ids=$(sort -u ids | comm -13 - links)
    [ -z "$ids" ] || fault "$page links to what is not there: $ids"
    ! grep -qE 'base64,("|$)' "$page" || fault "$page has empty data"
    ! grep -qE '[ >(]-?(nan|inf)[ <)]' "$page" || fault "$page shows what is no number"
    figures=$(grep -c '<figure class="plot">' "$page" || true)
    [ "$(grep -c '<svg class="floe-plot"' "$page")" -ge "$figures" ] || fault "$page lacks drawings"
    [ "$(grep -o 'data:text/csv;base64,' "$page" | wc -l)" -ge "$figures" ] || fault "$page lacks data"
}

# in_browser FILE: nothing is wider than the page, from phones to desks, all folds open; every picture shows; no requests.
in_browser() {
    local chromium
    chromium=$(command -v chromium || command -v chromium-browser || true)
    if [ -z "$chromium" ]; then
        echo 'skipped: no chromium to look at the page with'
        return
    fi
    sed "s|PAGE|$1|" >look.html <<'EOF'
<!DOCTYPE html><iframe id="f" src="PAGE" style="border:0;height:4000px"></iframe><pre id="out"></pre>
<script>
onload = () => {
  const f = document.getElementById('f'), out = [], d = f.contentDocument;
  d.querySelectorAll('details').forEach(e => e.open = true);
  // A film shows one picture, another one by its slider.
  d.querySelectorAll('.film').forEach(film => {
    const shown = () => [...film.querySelectorAll('figure')].map(e => e.getBoundingClientRect().height > 150), slider = film.querySelector('input');
    if (shown().filter(Boolean).length !== 1 || !shown().pop()) out.push('FAULT: a film does not show its last picture');
    slider.value = 0;
    slider.dispatchEvent(new Event('input'));
    if (shown().filter(Boolean).length !== 1 || !shown()[0]) out.push('FAULT: a slider shows no other picture');
  });
  for (const w of [360, 390, 768, 1280]) {
    f.style.width = w + 'px';
    if (d.documentElement.scrollWidth > w) out.push('FAULT at ' + w + ': page is ' + d.documentElement.scrollWidth + ' wide');
    d.querySelectorAll('body *').forEach(e => {
      if (e.closest('.scroll, svg > *') || e.getBoundingClientRect().right <= w + 1) return;
      out.push('FAULT at ' + w + ': too wide: ' + e.tagName + ' ' + e.className + ' ' + e.textContent.slice(0, 40));
    });
    d.querySelectorAll('svg.floe-plot').forEach(e => {
      if (e.closest('[hidden]')) return;
      if (e.getBoundingClientRect().height < 100 || e.querySelectorAll('path').length < 5) out.push('FAULT: empty drawing');
    });
  }
  d.querySelectorAll('img').forEach(e => { if (!(e.naturalWidth > 0)) out.push('FAULT: missing picture ' + e.alt); });
  f.contentWindow.performance.getEntriesByType('resource').forEach(e => {
    if (!e.name.startsWith('data:')) out.push('FAULT: asks for ' + e.name);
  });
  document.getElementById('out').textContent = out.join('\n') + '\nLOOKED ' + d.querySelectorAll('figure').length;
};
</script>
EOF
    HOME=$work timeout 120 "$chromium" --headless --no-sandbox --disable-gpu --user-data-dir="$work/browser" \
        --allow-file-access-from-files --virtual-time-budget=20000 --dump-dom "file://$work/look.html" \
        >looked 2>/dev/null || fault 'chromium has failed'
    has looked 'LOOKED'
    ! grep FAULT looked | grep -v push >&2 || fault "$1 does not look right"
}

# Results to report of: cases side by side, a run whose title is markup, one that has diverged.
expect 0 "$FLOE" compare "$cylinder" --axis domain.cell=0.2,0.1 --set time.end=1e-3 --repeat 0 -o cmp --quiet
expect 0 "$FLOE" run "${tiny[@]}" --set time.end=5e-4 --set 'title="<b> & \"it'"'"'s\" mine"' -o run --quiet
expect 3 "$FLOE" run "${tiny[@]}" --set time.fixed_step=1e-4 -o bad --quiet

# A study with what it requires, a search, and a map.
required='study.require=[{metric: eq13, order: 9, where: {coupling: mpm}}, {metric: eq13, error: 99}]'
expect 6 "$FLOE" study "$cylinder" --set study=null --axis domain.cell=0.4,0.2 --axis coupling=mpm,ice-mpm --set "$required" \
    --set 'study.quantities=[strain]' --set time.end=1e-3 -o study --quiet
line=("$FLOE_SOURCE/inputs/stability_line.yaml" --each 'method.stress=usl,usf' --set time.max_steps=200 --quiet)
expect 0 "$FLOE" stability "${line[@]}" --over time.fixed_step=0.0006:0.0024 --tolerance 0.2 -o search
expect 0 "$FLOE" stability "${line[@]}" --over time.fixed_step=5e-4,3e-3 --over method.flip=0.9,1 -o map
# All of them.
export FLOE_PYTHON=$python
expect 0 "$FLOE" report cmp run bad study search map -o all.html --title 'Three <b>'
has stdout 'report: all.html'
whole_page all.html
in_browser all.html
has all.html ' choose '
has all.html '&lt;b&gt; &amp;'
has all.html '>diverged<'
has all.html 'would cross more than a cell'
has all.html 'Conservation'
has all.html 'Time by stage'
has all.html 'inner_radius: 0.5' # the deck as resolved
has all.html "$(json run/summary.json compiler)"
has all.html "$(json run/summary.json version)"
has all.html "$(json run/summary.json machine)"
# Pictures: of a run each snapshot up to twelve, of each case of a comparison the last.
pictures=$(($(find run/fields bad/fields -name '*.h5' | wc -l) + 4 + 4))
[ "$(grep -c '<figure class="picture">' all.html)" -eq "$pictures" ] || fault "not $pictures pictures"
has all.html '>missed<'
has all.html '>met<'
has all.html '>found<'
has all.html 'energy grows'
answer=$(json study/study.json text)
has all.html "${answer:1}."
[ "$(json search/stability.json stable)" != null ] || fault 'no limit was found'
is_there all_files/*.csv all_files/*-run-000000.svg
# A case's error as the page shows it is that of its run.
eq13=$(awk -v x="$(json cmp/mpm-0.1/summary.json eq13)" 'BEGIN { printf "%.4g", 100 * x }')
has all.html ">$eq13 %<"

# One folder: the page is in it.
expect 0 "$FLOE" report run/ --quiet --times 0,1e-4,2e-4,9 # the last snapshot is the nearest to all but 0 s
[ ! -s stdout ] || fault 'not quiet'
whole_page run/report.html
[ "$(grep -c '<figure class="picture">' run/report.html)" -eq 2 ] || fault 'no pictures at the times'
is_there run/report_files

# Folders of other versions: what is missing is left out.
mkdir old
echo '{"schema": 1, "status": "done", "errors": {"eq13": null}}' >old/summary.json
printf 'time (s),kinetic (J)\n0,nan\n1' >old/history.csv # and half a row
expect 0 "$FLOE" report old -o old.html
whole_page old.html

# What is no result is refused before anything is written.
mkdir none
expect 4 "$FLOE" report run none -o refused.html
has stderr "'none' holds no results"
expect 4 "$FLOE" report nowhere -o refused.html
has stderr "there is no folder 'nowhere'"
mkdir cut && touch cut/history.csv
expect 4 "$FLOE" report cut -o refused.html
has stderr 'has not ended'
[ ! -e refused.html ] && [ ! -e refused_files ] || fault 'written all the same'
echo '{' >none/summary.json
expect 4 "$FLOE" report none -o refused.html
has stderr 'none/summary.json'

# A damaged snapshot costs the pictures, not the page.
for snapshot in run/fields/*.h5; do printf x >"$snapshot"; done
expect 0 "$FLOE" report run -o damaged.html
has stderr 'no pictures of'
whole_page damaged.html

expect 2 "$FLOE" report run --times 1,x
expect 2 "$FLOE" report

# Without Python: one line that says what to install.
expect 4 env FLOE_PYTHON="$work/none" "$FLOE" report run -o without.html
has stderr 'install python3-numpy, python3-h5py, python3-matplotlib and python3-jinja2'
[ ! -e without.html ] || fault 'a page without Python'
