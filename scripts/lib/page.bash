# What scripts/results.sh makes its pages with. Sourced. A page is Markdown, written line by line to $page; its numbers come from
# the CSV files that floe writes, by awk; its plots are made by gnuplot.
# shellcheck shell=bash

# column FILE NAME: the number of the column of that name, whatever unit follows it; fails if there is none.
column() {
    awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) { t = $i; sub(/ \(.*/, "", t); if (t == name) { print i; found = 1; exit } }
        exit } END { exit !found }' "$1" || { echo "no column $2 in $1" >&2; return 1; }
}

# value FILE COUPLING CASE NAME: what that run has in that column; CASE is the value of the axis, or the number of the case without one.
value() {
    local at
    at=$(column "$1" "$4") || return
    awk -F, -v c="$2" -v v="$3" -v at="$at" 'NR > 1 { t = $2; gsub(/"/, "", t); if ($1 == c && (t == v || v == "")) { print $at; exit } }' "$1"
}

# cases FILE COUPLING: the values of the axis, as they were given.
cases() {
    awk -F, -v c="$2" 'NR > 1 && $1 == c { gsub(/"/, "", $2); print $2 }' "$1"
}

# order FILE COUPLING METRIC: "slope stderr" of log(error) over log(h), by least squares; the same fit as floe's own.
order() {
    local at
    at=$(column "$1" "$3") || return
    awk -F, -v c="$2" -v at="$at" 'NR > 1 && $1 == c && $at > 0 { n++; x[n] = log($3); y[n] = log($at); X += x[n]; Y += y[n] }
        END { if (n < 2) { print "nan nan"; exit }
              X /= n; Y /= n
              for (i = 1; i <= n; i++) { xx += (x[i] - X)^2; xy += (x[i] - X) * (y[i] - Y) }
              b = xy / xx
              for (i = 1; i <= n; i++) r += (y[i] - Y - b * (x[i] - X))^2
              printf("%.4f %s\n", b, (n > 2 ? sprintf("%.4f", sqrt(r / (n - 2) / xx)) : "nan")) }' "$1"
}

# calc FORMAT EXPRESSION: awk's answer.
calc() {
    awk "BEGIN { printf \"$1\", $2 }"
}

# write TEXT...: lines of the page; without text, an empty one.
write() {
    if [ $# -eq 0 ]; then echo >>"$page"; else printf '%s\n' "$@" >>"$page"; fi
}

# begin NAME TITLE: a new page, its folder of runs, and no bars yet.
begin() {
    name=$1
    title=$2
    page=$results/$name.md
    runs=out/results/$name
    commands=()
    made_also=()
    kept=
    earlier_stamp=$(grep -s '^\*Made from sources' "$page" | tail -n 1 || true)
    mkdir -p "$runs" "$results"
    rm -f "$results/$name"-*.svg "$results/$name"-*.csv
    printf '# %s\n\n*Written by `scripts/results.sh %s`; do not edit.*\n\n' "$title" "$name" >"$page"
    [ -f "$bars" ] || echo 'page,what,measured,bar,met' >"$bars"
    grep -v "^$name," "$bars" >"$bars.new" || true
    mv "$bars.new" "$bars"
}

# note_command COMMAND ARGUMENT...: a command as the page shows it.
note_command() {
    local text="floe $1" word
    shift
    for word in "$@"; do
        case $word in *[][*?{}\ ]*) text+=" '$word'" ;; *) text+=" $word" ;; esac
    done
    commands+=("$text")
}

# floe_command COMMAND FILE FOLDER ARGUMENT...: runs a command that makes CSV, one thread a run, and remembers it.
floe_command() {
    local command=$1 file=$2 folder=$3 log=$runs/$3.txt
    shift 3
    note_command "$command" "$@"
    echo "  ${commands[-1]}" >&2
    rm -rf "${runs:?}/$folder"
    "$floe" "$command" "$@" --threads 1 -o "$runs/$folder" >"$log" 2>"$log.err" || {
        echo "results.sh: failed: floe $command $*; see $log.err" >&2
        return 1
    }
    csv=$runs/$folder/$file
}

# floe_compare FOLDER ARGUMENT...: runs a comparison of the page, one thread a run, and remembers its command.
floe_compare() {
    floe_command compare compare.csv "$@"
}

# floe_stability FOLDER ARGUMENT...: the same with a search for a limit.
floe_stability() {
    floe_command stability limits.csv "$@"
}

# floe_run FOLDER ARGUMENT...: one run; $csv is its history.
floe_run() {
    floe_command run history.csv "$@" --quiet
}

# floe_run_kept FOLDER ARGUMENT...: one run, or the one that lies finished there.
floe_run_kept() {
    csv=$runs/$1/history.csv
    if grep -qs '"status": "done"' "$runs/$1/summary.json" && [ -f "$csv" ]; then
        shift
        kept=1
        note_command run "$@" --quiet
    else
        floe_run "$@"
    fi
}

# bar WHAT MEASURED RELATION LIMIT [FORMAT [UNIT]]: adds a bar, met or missed, to the page's and to the index. RELATION is <= or >=.
bar() {
    local format=${5:-%.3g} unit=${6:-} met
    met=$(awk -v a="$2" -v b="$4" -v r="$3" 'BEGIN { if (a !~ /^[-+]?[0-9.]/) { print "missed"; exit }
        print (r == "<=" ? a + 0 <= b + 0 : a + 0 >= b + 0) ? "met" : "missed" }')
    local measured limit
    # shellcheck disable=SC2059 # a format given by the caller
    measured=$(printf "$format" "$2")$unit limit=$4$unit
    printf '%s,"%s",%s,%s %s,%s\n' "$name" "$1" "$measured" "$3" "$limit" "$met" >>"$bars"
    [ "$met" = met ] || printf 'results.sh: %s: missed: %s: %s instead of %s %s\n' "$name" "$1" "$measured" "$3" "$limit" >&2
}

# order_table FILE COUPLING METRIC...: errors at each spacing, and the fitted order.
order_table() {
    local file=$1 coupling=$2 h m b s head='| h | steps |' rule='|---|---|' row orders='| **order** | |'
    shift 2
    for m in "$@"; do
        head+=" $m |"
        rule+='---|'
    done
    write "$head wall time |" "$rule---|"
    for h in $(cases "$file" "$coupling"); do
        row="| $h | $(value "$file" "$coupling" "$h" steps) |"
        for m in "$@"; do row+=" $(printf %.3e "$(value "$file" "$coupling" "$h" "$m")") |"; done
        write "$row $(printf %.2g "$(value "$file" "$coupling" "$h" wall_seconds)") s |"
    done
    for m in "$@"; do
        read -r b s < <(order "$file" "$coupling" "$m")
        orders+=$(printf ' **%.2f** ± %.2f |' "$b" "$s")
    done
    write "$orders |" ''
}

# order_bar WHAT FILE COUPLING METRIC LIMIT
order_bar() {
    local b s
    read -r b s < <(order "$2" "$3" "$4")
    bar "$1 (± $(printf %.2f "$s"))" "$b" '>=' "$5" %.2f
}

# show_bars: the page's bars as a table.
show_bars() {
    write '| what | measured | bar | |' '|---|---|---|---|'
    awk -v name="$name" 'index($0, name ",\"") == 1 { rest = substr($0, length(name) + 3); q = index(rest, "\","); what = substr(rest, 1, q - 1)
        split(substr(rest, q + 2), f, ","); printf "| %s | %s | %s | %s |\n", what, f[1], f[2], f[3] == "met" ? "met" : "**missed**" }' "$bars" >>"$page"
}

# plot FILE: gnuplot's commands from standard input, into FILE.svg of the page.
plot() {
    local file=$results/$name-$1.svg
    {
        echo "set terminal svg size ${2:-760,520} dynamic background rgb 'white' font 'sans-serif,14'"
        echo "set output '$file'"
        echo "set datafile separator ','"
        echo "set grid lc rgb '#d0d0d0'"
        echo "mpm = '#c03020'; ice = '#1060b0'; grey = '#606060'"
        cat
    } >"$runs/$1.gp"
    if command -v gnuplot >/dev/null; then
        gnuplot "$runs/$1.gp" 2>"$runs/$1.gp.err" || { cat "$runs/$1.gp.err" >&2; return 1; }
    else
        echo "results.sh: no gnuplot: no $file" >&2
    fi
}

# finish: how the page was made: commands, program, machine.
finish() {
    write '' '## How' '' 'Each run has one thread. The commands, with `build/release/floe` as `floe`:' ''
    local command
    for command in "${commands[@]}"; do write "    $command"; done
    write '' 'Made with' ''
    "$floe" --version | sed 's/^/    /' >>"$page"
    write "    $(machine)"
}

# stamp_page: the last line of the page: what it was made from (scripts/lib/stamp.py), with what else of the tree stands in $made_also. A page
# that keeps pictures or runs of earlier ones ($kept) keeps its earlier stamp.
stamp_page() {
    local line=$earlier_stamp
    if [ -z "$kept" ]; then
        line=$(printf '%s\n' "${commands[@]}" | FLOE=$floe /usr/bin/python3 scripts/lib/stamp.py line "$name" "$runs" ${made_also[@]+"${made_also[@]}"}) || return
    fi
    [ -n "$line" ] || return 0
    write '' "$line"
    sed -i "/^$name\$/d" scripts/results/unstamped.txt
}

machine() {
    printf '%s, %s cores' "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1 | grep . || uname -m)" "$(getconf _NPROCESSORS_ONLN)"
}
