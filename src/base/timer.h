/* Wall and CPU time. */
#ifndef BASE_TIMER_H
#define BASE_TIMER_H

double wall_seconds(void); /* monotonic, from an arbitrary origin */
double cpu_seconds(void);  /* of the process */
/* Peak memory of the process (bytes); 0 where the system does not report it. */
long long peak_rss_bytes(void);

#endif
