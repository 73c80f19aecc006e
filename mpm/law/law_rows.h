/* What an includer of the three .def files does not ask for is nothing.  Included again and again. */
#ifndef CONSTANT
#define CONSTANT(member, unit, fallback, least, largest, text)
#endif
#ifndef NEEDS
#define NEEDS(member)
#endif
