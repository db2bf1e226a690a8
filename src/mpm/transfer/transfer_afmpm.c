#include "mpm/transfer/transfer.h"

extern const transfer_model transfer_afmpm;

const transfer_model transfer_afmpm = {
    .name = "afmpm",
    .doc = "apic without what its passes smooth, the higher the order the more exactly",
    .cite = "Nairn and Hammerquist 2021, with the moments of Jiang et al. 2015",
    .share = 0.0,
    .carry = CARRY_MOMENTS,
    .restore = true,
    .order = 4, /* with hats terms alike, else with shares of their own (restore.c) */
    .keeps_spin = true,
    .keeps_rigid_motion = true,
};
