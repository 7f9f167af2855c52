/* The naive variant: rays in an object's coordinates start where they start. */
#ifndef CLUCIDA_PACKETS_APPROACH_H
#define CLUCIDA_PACKETS_APPROACH_H

INLINED void wide_approach(WideLine* l, __global const LayoutObject* object)
{
    (void)l;
    (void)object;
}

#endif
