/* Axes as the command line writes them: KEY=V1,V2,... */
#ifndef STUDY_AXIS_TEXT_H
#define STUDY_AXIS_TEXT_H

#include "scene/scene.h"

/* Reads "KEY=V1,V2,..."; a comma in brackets or braces belongs to its value. `option` names the option in messages, "--axis".
 * FLOE_BAD_INPUT: no key, no value, too many, or too long ones. */
floe_status axis_from_text(context *ctx, const char *option, const char *text, scene_axis *axis);

#endif
