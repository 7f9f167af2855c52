/* The naive variant's epsilon, in units of length, whatever the scene: of 1e-3, 1e-4 and 1e-5 the one by which most of
 * the scenes in scenes/ come out best. */
#ifndef CLUCIDA_EPSILON_H
#define CLUCIDA_EPSILON_H

#define EPSILON R(1e-3f)

#endif
