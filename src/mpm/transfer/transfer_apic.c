#include "mpm/transfer/transfer.h"

#include <math.h>

extern const transfer_model transfer_apic;

const transfer_model transfer_apic = {
    .name = "apic",
    .doc = "pic with the moments of the velocity about each point",
    .cite = "Jiang, Schroeder, Selle, Teran and Stomakhin 2015",
    .share = 0.0,
    .carry = CARRY_MOMENTS,
    .keeps_spin = true,
    .keeps_rigid_motion = true,
};
