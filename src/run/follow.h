/* The folder of a run that goes while the run lasts: it is followed where it was moved, and made anew where it was removed. */
#ifndef RUN_FOLLOW_H
#define RUN_FOLLOW_H

#include "run/output.h"

typedef enum follow_state {
    FOLLOW_HERE,
    FOLLOW_MOVED, /* and the outputs have followed */
    FOLLOW_ANEW   /* the folder, or its files, were removed: there are new ones, without what was written before */
} follow_state;

/* Looks where DIR is, before something is written there. FLOE_IO where it is gone and cannot be made anew. */
floe_status output_follow(run_output *o, const sim *s, follow_state *state);

/* The same once something could not be written, for the reason `cause`: a file that was not there any more may be the
 * first that has gone of a folder which is being removed. */
floe_status output_follow_failure(run_output *o, const sim *s, const char *cause, follow_state *state);

#endif
