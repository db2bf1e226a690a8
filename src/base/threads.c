#include "base/threads.h"

#ifdef _OPENMP
#include <omp.h>

int threads_use(int count)
{
    if (count > 0) omp_set_num_threads(count);
    return omp_get_max_threads();
}

int threads_most(void)
{
    return omp_get_max_threads();
}

int thread_number(void)
{
    return omp_get_thread_num();
}

#else

int threads_use(int count)
{
    (void)count;
    return 1;
}

int threads_most(void)
{
    return 1;
}

int thread_number(void)
{
    return 0;
}

#endif
