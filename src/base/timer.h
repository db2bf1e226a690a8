/* Wall and CPU time. */
#ifndef BASE_TIMER_H
#define BASE_TIMER_H

double wall_seconds(void); /* monotonic, from an arbitrary origin */
double cpu_seconds(void);  /* of the process */
/* The most memory that the process has held at a time (bytes); 0 where the system does not tell. */
long long peak_rss_bytes(void);

#endif
