#include "mpm/transfer/transfer.h"

#include <math.h>

extern const transfer_model transfer_pic;

const transfer_model transfer_pic = {
    .name = "pic",
    .doc = "points take the velocities of the nodes: no noise is left, and little of anything finer than a cell",
    .cite = "Harlow 1964",
    .share = 0.0,
};
