#include "ice/ice_internal.h"
floe_status ice_mixture(ice *s, int block_id, const ice_view *v) { (void)s;(void)block_id;(void)v; return FLOE_OK; }
floe_status ice_exchange(ice *s) { (void)s; return FLOE_OK; }
floe_status ice_specific_volume(ice *s) { (void)s; return FLOE_OK; }
void ice_viscous(ice *s, const ice_view *v) { (void)s;(void)v; }
