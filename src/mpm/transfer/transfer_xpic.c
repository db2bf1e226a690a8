#include "mpm/transfer/transfer.h"

#include <math.h>

extern const transfer_model transfer_xpic;

const transfer_model transfer_xpic = {
    .name = "xpic",
    .doc = "flip without what the mesh does not see, the higher the order the more exactly",
    .cite = "Hammerquist and Nairn 2017",
    .share = 1.0,
    .filter = true,
    .order = 2,
};
