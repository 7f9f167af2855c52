/* The re-origined variant's epsilon, chosen as the naive one's: it can do with less. */
#ifndef CLUCIDA_EPSILON_H
#define CLUCIDA_EPSILON_H

#define EPSILON R(1e-4f)

#endif
