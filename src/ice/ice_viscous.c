#include "ice/ice_internal.h"
void ice_viscous(ice *s, const ice_view *v) { (void)s; (void)v; }
