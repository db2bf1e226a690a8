#include "mpm/transfer/transfer.h"

#include <math.h>

extern const transfer_model transfer_flip;

const transfer_model transfer_flip = {
    .name = "flip",
    .doc = "points keep their velocities and take the accelerations; method.flip blends with pic",
    .cite = "Brackbill and Ruppel 1986; Sulsky, Chen and Schreyer 1994",
    .share = NAN,
};
