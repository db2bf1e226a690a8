#include "mpm/transfer/transfer.h"

#include <math.h>

extern const transfer_model transfer_tpic;

const transfer_model transfer_tpic = {
    .name = "tpic",
    .doc = "pic with the gradient of the velocity at each point",
    .cite = "Nakamura, Matsumura and Mizutani 2023",
    .share = 0.0,
    .carry = CARRY_GRADIENT,
    .keeps_rigid_motion = true,
};
