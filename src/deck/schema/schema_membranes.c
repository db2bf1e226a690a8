/* Membranes and strings: bodies that lie along a curve or on a surface in space. */
#include "deck/deck_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool body_is_membrane(const scene *s, const void *body)
{
    const int material = ((const scene_body *)body)->material;
    return material >= 0 && s->material[material].membrane;
}

/* ---- curves ---- */

static const key_spec segment_keys[] = {
    {"from", KEY_VECTOR, "m", AT(curve_line, from), .required = true, .doc = "first end"},
    {"to", KEY_VECTOR, "m", AT(curve_line, to), .required = true, .doc = "second end"},
};
static const key_table segment_table = TABLE(segment_keys);

static const key_spec arc_keys[] = {
    {"centre", KEY_VECTOR, "m", AT(curve_line, centre), .required = true, .doc = "centre"},
    {"radius", KEY_NUMBER, "m", PARAM_POSITIVE, AT(curve_line, radius), .required = true, .doc = "radius"},
    {"from", KEY_NUMBER, "rad", AT(curve_line, angle_from), .required = true,
     .doc = "angle of the first end from the first axis, anticlockwise"},
    {"to", KEY_NUMBER, "rad", AT(curve_line, angle_to), .required = true, .doc = "angle of the second end"},
};
static const key_table arc_table = TABLE(arc_keys);

static const key_spec circle_keys[] = {
    {"centre", KEY_VECTOR, "m", AT(curve_line, centre), .required = true, .doc = "centre"},
    {"radius", KEY_NUMBER, "m", PARAM_POSITIVE, AT(curve_line, radius), .required = true, .doc = "radius"},
};
static const key_table circle_table = TABLE(circle_keys);

static const key_spec polyline_keys[] = {
    {"vertices", KEY_SPECIAL, .special = &special_positions, .required = true, .doc = "straight from one to the next"},
    {"closed", KEY_BOOL, AT(curve_line, closed), .fallback = "false", .doc = "true: the last is joined to the first"},
};
static const key_table polyline_table = TABLE(polyline_keys);

static const key_spec points_keys[] = {
    {"at", KEY_SPECIAL, .special = &special_positions, .required = true, .doc = "every material point, in order"},
    {"closed", KEY_BOOL, AT(curve_line, closed), .fallback = "false", .doc = "true: the last is joined to the first"},
};
static const key_table points_table = TABLE(points_keys);

static const variant curve_list[] = {
    {"segment", CURVE_SEGMENT, &segment_table, "a straight line"},
    {"arc", CURVE_ARC, &arc_table, "part of a circle, in the plane of the first two axes"},
    {"circle", CURVE_CIRCLE, &circle_table, "a whole circle, closed"},
    {"polyline", CURVE_POLYLINE, &polyline_table, "straight lines through vertices"},
    {"points", CURVE_POINTS, &points_table, "the material points themselves, as York's decks list them"},
};

static void choose_curve(void *field, int value)
{
    ((curve_line *)field)->kind = (curve_kind)value;
}

static int chosen_curve(const void *field)
{
    return (int)((const curve_line *)field)->kind;
}

static const variants curve_kinds = {"curve", curve_list, sizeof curve_list / sizeof curve_list[0], choose_curve,
                                     chosen_curve};

/* ---- surfaces ---- */

static const choice axis_choices[] = {
    {"x", 0, "the first axis"},
    {"y", 1, "the second axis"},
    {"z", 2, "the third axis"},
    {0},
};

static const key_spec sphere_keys[] = {
    {"centre", KEY_VECTOR, "m", AT(sheet_surface, centre), .required = true, .doc = "centre"},
    {"radius", KEY_NUMBER, "m", PARAM_POSITIVE, AT(sheet_surface, radius), .required = true, .doc = "radius"},
    {"axis", KEY_CHOICE, AT(sheet_surface, axis), .fallback = "z", .choices = axis_choices,
     .doc = "about which the bands of its points lie"},
};
static const key_table sphere_table = TABLE(sphere_keys);

static const key_spec cylinder_keys[] = {
    {"centre", KEY_VECTOR, "m", AT(sheet_surface, centre), .required = true, .doc = "a place on its axis"},
    {"radius", KEY_NUMBER, "m", PARAM_POSITIVE, AT(sheet_surface, radius), .required = true, .doc = "radius"},
    {"axis", KEY_CHOICE, AT(sheet_surface, axis), .fallback = "z", .choices = axis_choices, .doc = "its direction"},
    {"from", KEY_NUMBER, "m", AT(sheet_surface, from), .required = true, .doc = "where it begins along the axis"},
    {"to", KEY_NUMBER, "m", AT(sheet_surface, to), .required = true, .doc = "where it ends"},
};
static const key_table cylinder_table = TABLE(cylinder_keys);

static const key_spec revolved_keys[] = {
    {"curve", KEY_VARIANT, AT(sheet_surface, curve), .variants = &curve_kinds, .required = true,
     .doc = "what is turned: only distance from the axis and place along it count; arcs are turned about x or y"},
    {"axis", KEY_CHOICE, AT(sheet_surface, axis), .fallback = "y", .choices = axis_choices,
     .doc = "about which it is turned"},
    {"centre", KEY_VECTOR, "m", AT(sheet_surface, centre), .required = true, .doc = "a place on the axis"},
};
static const key_table revolved_table = TABLE(revolved_keys);

static const key_spec plane_keys[] = {
    {"corner", KEY_VECTOR, "m", AT(sheet_surface, corner), .required = true, .doc = "a corner"},
    {"first", KEY_VECTOR, "m", AT(sheet_surface, first), .required = true, .doc = "from there to the next"},
    {"second", KEY_VECTOR, "m", AT(sheet_surface, second), .required = true, .doc = "from there to the one before"},
};
static const key_table plane_table = TABLE(plane_keys);

static const key_spec listed_keys[] = {
    {"at", KEY_SPECIAL, .special = &special_sheet_positions, .required = true,
     .doc = "every material point, in any order"},
    {"area", KEY_NUMBER, "m2", PARAM_POSITIVE, AT(sheet_surface, area), .required = true,
     .doc = "of the surface, which they share alike"},
};
static const key_table listed_table = TABLE(listed_keys);

static const variant surface_list[] = {
    {"sphere", SHEET_SPHERE, &sphere_table, "a sphere; sides of the domain through its centre cut it"},
    {"cylinder", SHEET_CYLINDER, &cylinder_table,
     "the shell of a cylinder, without ends; sides of the domain through its axis cut it"},
    {"revolve", SHEET_REVOLVED, &revolved_table, "a curve turned about an axis; sides of the domain through it cut it"},
    {"plane", SHEET_PLANE, &plane_table, "a parallelogram"},
    {"points", SHEET_POINTS, &listed_table, "the material points themselves"},
};

static void choose_surface(void *field, int value)
{
    ((sheet_surface *)field)->kind = (sheet_kind)value;
}

static int chosen_surface(const void *field)
{
    return (int)((const sheet_surface *)field)->kind;
}

static const variants surface_kinds = {"surface", surface_list, sizeof surface_list / sizeof surface_list[0],
                                       choose_surface, chosen_surface};

/* ---- membranes ---- */

static bool scene_has_space(const scene *s, const void *membrane)
{
    (void)membrane;
    return s->mesh.dim == 3;
}

static bool lies_along_curve(const scene *s, const void *membrane)
{
    (void)s;
    return ((const scene_membrane *)membrane)->surface.kind == SHEET_NONE;
}

static const choice section_choices[] = {
    {"thickness", SECTION_THICKNESS, "the thickness stays as it is"},
    {"volume", SECTION_VOLUME, "the volume stays, the thickness shrinks"},
    {0},
};

static const choice strain_choices[] = {
    {"rate", STRAIN_BY_RATE, "it grows with the gradient of velocity at the point"},
    {"positions", STRAIN_BY_POSITIONS,
     "the distance between its neighbours over that at rest; `normals` says how neighbours are found"},
    {0},
};

static const key_spec membrane_keys[] = {
    {"surface", KEY_VARIANT, AT(scene_membrane, surface), .variants = &surface_kinds, .applies = scene_has_space,
     .belongs = "scenes in 3-D", .otherwise = "none: it lies along a curve",
     .doc = "in 3-D: the surface on which it lies"},
    {"curve", KEY_VARIANT, AT(scene_membrane, curve), .variants = &curve_kinds, .required = true,
     .applies = lies_along_curve, .belongs = "membranes without a 'surface'",
     .doc = "the line along which it lies, where it has no surface"},
    {"thickness", KEY_NUMBER, "m", PARAM_POSITIVE, AT(scene_membrane, thickness), .required = true,
     .doc = "thickness at the start; in 1-D the share of the section; of a curve in 3-D the section (m2)"},
    {"number", KEY_WHOLE, NULL, WITHIN(0, 1e7), AT(scene_membrane, number), .fallback = "0",
     .doc = "material points along the curve, or about as many on the surface; 0: by the body's `points` a cell"},
    {"length", KEY_NUMBER, "m", PARAM_POSITIVE, AT(scene_membrane, length),
     .otherwise = "half the way to each neighbour", .doc = "of a curve of points: its length, which they share alike"},
    {"normals", KEY_MODEL, .family = &family_normals,
     .otherwise = "`connectivity`, the order of the points along the curve; of a surface `quadric`",
     .doc = "how the normals of the points are found; all but `connectivity` take the points as they lie, in any "
            "order, and find their neighbours (`strain: positions`) from that, too"},
    {"section", KEY_CHOICE, AT(scene_membrane, section), .fallback = "thickness", .choices = section_choices,
     .doc = "what becomes of it as it is stretched"},
    {"strain", KEY_CHOICE, AT(scene_membrane, strain), .fallback = "rate", .choices = strain_choices,
     .renamed_choice = {"places", "positions"}, .doc = "how the strain of a point along the curve is found"},
    {"smoothing", KEY_NUMBER, NULL, WITHIN(0.0, 0.0625), AT(scene_membrane, smoothing), .fallback = "0",
     .doc = "share of the fourth difference of their positions that is taken off in a step; with `strain: positions`"},
    {"slack", KEY_NUMBER, NULL, WITHIN(-2.0, 5.0), AT(scene_membrane, slack), .fallback = "0",
     .doc = "logarithmic strain that must be taken up before there is tension, about an axis and of a surface in both "
            "directions; "
            "negative: taut at the start. With `section: thickness` the mass is that of the length or area without "
            "strain"},
    {"slack_from", KEY_WHOLE, NULL, WITHIN(0, 1e7), AT(scene_membrane, slack_from), .fallback = "0",
     .doc = "first point with slack, counted from 1; 0: the first of all"},
    {"slack_to", KEY_WHOLE, NULL, WITHIN(0, 1e7), AT(scene_membrane, slack_to), .fallback = "0",
     .doc = "last point with slack; 0: the last of all"},
    {"heavy_point", KEY_WHOLE, NULL, WITHIN(0, 1e7), AT(scene_membrane, heavy_point), .fallback = "0",
     .doc = "a point with a mass of its own, counted from 1; 0: none"},
    {"heavy_mass", KEY_NUMBER, "kg", PARAM_POSITIVE, AT(scene_membrane, heavy_mass), .otherwise = "as the others",
     .doc = "its mass, of the whole scene (for domain.thickness, or the full circle)"},
    {"encloses", KEY_MATERIAL, AT(scene_membrane, encloses), .formerly = "holds", .otherwise = "none",
     .doc = "beside cells (ice-mpm): the gas on its left, seen along the curve, or inside the surface (behind first x "
            "second of a plane), which it separates from the gas on its other side; this boundary joins the points in "
            "their order, whatever `normals`. As mpm, of a surface: the gas points inside, which fill the enclosed "
            "volume"},
};
const key_table membrane_table = TABLE(membrane_keys);

static floe_status check_heavy(reader *r, deck_node *node, const scene_body *b)
{
    const scene_membrane *m = &b->membrane;
    if ((m->heavy_point > 0) == (m->heavy_mass > 0.0)) return FLOE_OK;
    return bad_key(r, node, "heavy_point and heavy_mass, or neither", NULL,
                   "membrane '%s' has one of heavy_point and heavy_mass without the other", b->name);
}

static const key_spec normals_of_surface = {"normals", KEY_MODEL, .family = &family_normals};

/* What a surface in space asks for: a law that bears alike in all directions, and normals that no order of the points gives. */
static floe_status check_surface(reader *r, deck_node *node, scene_body *b)
{
    scene_membrane *m = &b->membrane;
    deck_node fallback = {.kind = NODE_SCALAR, .text = "quadric", .key = "normals"};
    if (!m->normals) TRY(read_key(r, &normals_of_surface, &fallback, m));
    if (m->normals && m->normals->connected)
        return bad_key(r, node, "normals: quadric, or another without connections", NULL,
                       "the points of membrane '%s' lie on a surface, in no order", b->name);
    if (!isnan(m->length))
        return bad_key(r, node, NULL, "leave 'length' out", "membrane '%s' has its area by its surface", b->name);
    if (m->surface.kind == SHEET_POINTS && m->number > 0)
        return bad_key(r, node, NULL, "leave 'number' out", "membrane '%s' lists its points and gives their number",
                       b->name);
    if (m->strain == STRAIN_BY_POSITIONS)
        return bad_key(r, node, "strain: rate", NULL,
                       "the points of membrane '%s' lie on a surface, and have no neighbours along a line", b->name);
    const scene_material *law = b->material < 0 ? NULL : &r->scene->material[b->material];
    if (!law || !law->membrane || law->membrane->isotropic) return FLOE_OK;
    return bad_key(r, node, "a material with membrane: plane_stress", NULL,
                   "membrane '%s' is a surface, and its law '%s' bears along a line alone", b->name,
                   law->membrane->name);
}

/* A membrane of one point has no direction: it is a mass that hangs on something. */
static floe_status check_count(reader *r, deck_node *node, const scene_body *b)
{
    const scene_membrane *m = &b->membrane;
    const bool listed = m->curve.kind == CURVE_POINTS;
    if (m->curve.kind == CURVE_POLYLINE && m->curve.n_vertices < 2)
        return bad_key(r, node, "two vertices or more", NULL, "the polyline of membrane '%s' has one vertex", b->name);
    if (listed && m->number > 0)
        return bad_key(r, node, NULL, "leave 'number' out", "membrane '%s' lists its points and gives their number",
                       b->name);
    if (!listed && !isnan(m->length))
        return bad_key(r, node, NULL, "leave 'length' out", "membrane '%s' has its length by its curve", b->name);
    const int n = listed ? m->curve.n_vertices : m->number;
    const int most = m->heavy_point > m->slack_to ? m->heavy_point : m->slack_to;
    const int named = most > m->slack_from ? most : m->slack_from;
    if (n == 0 || named <= n) return FLOE_OK;
    return bad_key(r, node, NULL, NULL, "membrane '%s' names its point %d, and has %d", b->name, named, n);
}

static floe_status check_strain(reader *r, deck_node *node, const scene_body *b)
{
    const scene_membrane *m = &b->membrane;
    if (m->strain == STRAIN_BY_POSITIONS || m->smoothing == 0.0) return FLOE_OK;
    return bad_key(r, node, "strain: positions", NULL,
                   "membrane '%s' has smoothing, which strains by rate would know nothing of", b->name);
}

floe_status end_membrane(reader *r, deck_node *node, scene_body *body)
{
    deck_node *at = node_find(node, "membrane");
    TRY(check_strain(r, at, body));
    TRY(check_heavy(r, at, body));
    if (body->membrane.surface.kind != SHEET_NONE) return check_surface(r, at, body);
    if (r->scene->mesh.dim == 3 && body->membrane.normals && !body->membrane.normals->connected)
        return bad_key(r, at, "surface: {...} in place of the curve, or no normals", NULL,
                       "the line of membrane '%s' has no one normal in space", body->name);
    return check_count(r, at, body);
}
