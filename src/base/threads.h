/* Threads of this process, OpenMP's where the compiler has it, else one. */
#ifndef BASE_THREADS_H
#define BASE_THREADS_H

/* Sets how many threads parallel regions take from now on, where `count` is above 0; returns how many they may take. */
int threads_use(int count);
/* How many a parallel region may take, at least 1: the size of what each has for itself. */
int threads_most(void);
/* The number of the thread that asks, 0 <= number < threads_most(). */
int thread_number(void);

#endif
