# gallery: one picture of every deck. Sourced by scripts/results.sh. With GALLERY_KEEP=1 a picture that is there is kept, so that a
# new deck costs its own run alone; the page then keeps its stamp.
# shellcheck shell=bash disable=SC2016,SC2034,SC2154 # Markdown has backquotes; names are shared with results.sh

# What a deck needs for a short run and a telling picture, by its name: arguments of `floe run` | of `floe picture` | what is seen. A deck
# that is not here is run as it stands.
declare -A gallery=(
    [acoustic_pulse]='||pressure'
    [airbag_200]='--set time.end=0.04|-w 300|stress of the bag and the cylinder at 40 ms'
    [airbag_500]='--set time.end=0.02|-w 300|stress of the bag and the cylinder at 20 ms'
    [annulus_traction]='--set domain.cell=0.05||von Mises stress under an outward traction'
    [burning_block]='|-t 9e-4 -p mass_share -c pressure|share of the points that is left, and the pressure, when half is burnt'
    [closed_vessel_burn]='|-c pressure|pressure, the same everywhere'
    [ball_net]='|-t 2.5 -r 0:200|the net throws the ball back, t = 2.5'
    [bar_mms]='|-p stress_xx -c none|stress of the driven bar'
    [bar_vibration]='|-p velocity_x -c none|velocity'
    [cell_crossing]='|-p velocity_x -c none|velocity'
    [closed_box]='||pressure'
    [couette]='|-c velocity_gas_x|velocity'
    [flow_mms]='||pressure'
    [fluid_stream]='|-c density_water|density of water'
    [fluid_tube]='||pressure'
    [free_stream]='||pressure: what is even stays even'
    [gas_expansion]='|-c none|pressure of the points'
    [heated_vessel]='|-c density_air|density: the hot air in the middle is thin'
    [heat_wave]='|-c density_gas|density'
    [hydrostatic_column]='||pressure'
    [isentropic_vortex]='|-c density_gas|density'
    [lid_cavity]='|-c velocity_liquid|speed'
    [low_mach_channel]='|-c velocity_gas_x|velocity along x'
    [low_mach_vortex]='|-c velocity_gas_x|velocity along x'
    [membrane_balloon]='--coupling ice-mpm||a balloon about its axis at rest: stress of the membrane and pressure of the gas'
    [membrane_circle]='||stress of the membrane and pressure of the gas'
    [membrane_dogbone]='--set domain.cell=0.1 --set time.end=1|-w 260|the slack contour fills'
    [membrane_sphere]='||an eighth of a balloon: stress of the membrane and pressure of the gas'
    [membrane_patch]='|-p velocity_x -c none|velocity of a taut sheet drawn out between two supports'
    [membrane_revolved]='||a dog-bone of revolution at rest: stress of the membrane and pressure of the gas'
    [membrane_tube]='||a quarter of a tube: stress of the membrane and pressure of the gas'
    [moving_walls]='|-p velocity_x -c pressure|pressure of the gas between the walls'
    [noh]='|-c density_gas|density'
    [pendulum]='|-t 0.5 -c none|tension of the string, t = 0.5'
    [piston_wave]='||pressure'
    [piston_membrane]='|-c density_fluid|density of the fluid behind the sheet'
    [piston_container]='|-p pressure -c none|pressure'
    [pulse_leaves]='|-t 0.4|pressure, t = 0.4'
    [pressed_cylinder]='--set domain.cell=0.025|-p stress_yy -c none -r -14000:0|stress across the contact of a cylinder on a block'
    [poiseuille]='--set domain.cell=0.125|-c velocity_liquid_x|velocity'
    [pressurized_sphere]='|-p stress_tt -c pressure|hoop stress of the steel, pressure of the gas'
    [pressurized_cylinder]='--coupling ice-mpm|-p sigma_theta -c pressure|hoop stress of the steel, pressure of the gas'
    [ring_mms]='--set domain.cell=0.05|-p velocity_x -c none|velocity along x of the driven ring'
    [riemann]='|-c density_gas|density'
    [sedov]='|-c density_gas|density'
    [relaxation]='|-c velocity_light_x|velocity of one of two gases, the same everywhere'
    [shock_plate]='|-p stress_xx -c pressure|the shock that comes back, and the wave in the plate'
    [slip_wall]='|-c velocity_air_x|velocity of the gas along an oblique wall'
    [sod]='--coupling ice|-c density_gas|density'
    [spring_mass]='|-t 0.0101 -c none|tension at the lowest point'
    [stability_line]='|-p velocity_x -c none|velocity'
    [stiff_cylinder]='|-p sigma_theta -c pressure|hoop stress of a ring a hundred times as stiff as steel, sub-stepped'
    [string_mass]='|-t 0.0202 -c none|tension of the string, t = 0.02'
    [taylor_bar]='||von Mises stress'
    [taylor_green]='|-c velocity_liquid_x|velocity along x'
    [two_bags]='||stress of two bags at rest, and the density of the air about them'
    [water_impact]='|-p velocity_x -c pressure|pressure of the water before and behind the block'
    [two_bars]='|-t 0.25|von Mises stress while they touch'
)

# gallery_picture FILE DECK RUN PICTURE: the picture, from a run with these arguments.
gallery_picture() {
    local log=$runs/$2.txt words
    echo "  $2" >&2
    rm -rf "${runs:?}/$2"
    read -r -a words <<<"$3"
    "$floe" run "$1" "${words[@]}" --threads 1 --quiet -o "$runs/$2" >"$log" 2>&1 || { cat "$log" >&2; return 1; }
    read -r -a words <<<"$4"
    "$floe" picture "$runs/$2" --width 400 "${words[@]}" -o "$results/gallery-$2.png" >>"$log" 2>&1 || { cat "$log" >&2; return 1; }
}

# gallery_deck FILE: its picture and its lines on the page.
gallery_deck() {
    local file=$1 deck run picture seen
    deck=$(basename "$file" .yaml)
    IFS='|' read -r run picture seen <<<"${gallery[$deck]-||}"
    if [ -f "$results/gallery-$deck.png" ] && [ -n "${GALLERY_KEEP:-}" ]; then
        kept=1
    else
        gallery_picture "$file" "$deck" "$run" "$picture"
    fi
    commands+=("floe run $file${run:+ $run}" 'floe picture')
    write "## $(sed -n 's/^title: *//p' "$file")" '' "\`$file\`${seen:+: $seen}." '' \
        "    floe run $file${run:+ $run} -o out/$deck" "    floe picture out/$deck --width 400${picture:+ $picture}" '' \
        "![$deck](gallery-$deck.png)" ''
}

result_gallery() {
    local file
    begin gallery 'Gallery: every deck and its picture'
    write 'Each deck of `inputs/`, run from a cold start by the command beside it, on one thread; what lasts long is run to an earlier end or on a' \
        'coarser mesh than the deck says.' ''
    for file in inputs/*.yaml; do gallery_deck "$file"; done
}
