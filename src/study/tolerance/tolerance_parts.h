/* The parts of a run to a tolerance. Private to src/study. */
#ifndef STUDY_TOLERANCE_PARTS_H
#define STUDY_TOLERANCE_PARTS_H

#include "study/study_internal.h"
#include "study/tolerance/tolerance.h"

/* tolerance.c */
/* The study's case behind a curve's. */
const study_case *tolerance_case(const tolerance *t, size_t curve, size_t at);
/* The estimate of a quantity by the cases of a curve up to that one. */
tolerance_estimate tolerance_estimate_at(const tolerance *t, size_t curve, size_t at);
/* Wall time of all cases so far (s). */
double tolerance_seconds(const tolerance *t);

/* tolerance_words.c */
/* An error as people read it: "0.43 %". */
void tolerance_error_text(const tolerance *t, double error, char text[TOLERANCE_TEXT]);
/* How the error of the chosen case is known. */
void tolerance_how(const tolerance *t, char text[TOLERANCE_TEXT]);
/* Why the chosen case was chosen, or why its variant was not gone on with. */
void tolerance_reason(const tolerance *t, char text[TOLERANCE_TEXT]);
void tolerance_why_left(const tolerance *t, size_t curve, char text[TOLERANCE_TEXT]);
/* FLOE_MISSED_BAR with how near the best case has come, and what the tolerance would take. */
floe_status tolerance_refuse(const tolerance *t);

/* tolerance_table.c: those that were run; NULL when memory is out. */
json_t *tolerance_cases_json(const tolerance *t);

/* tolerance_publish.c */
/* Makes DIR of the chosen case: its outputs, and its summary with how it was chosen, which comes last. */
floe_status tolerance_publish(tolerance *t);

#endif
