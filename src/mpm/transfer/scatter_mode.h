/* Quantities that a pass from points to nodes adds there. */
#ifndef MPM_SCATTER_MODE_H
#define MPM_SCATTER_MODE_H

typedef enum scatter_mode { SCATTER_MOMENTUM, SCATTER_FORCE, SCATTER_ALL, SCATTER_MODES } scatter_mode;

#endif
