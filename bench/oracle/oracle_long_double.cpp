#include "bench/oracle/instances.h"

namespace clucida::oracle {

CLUCIDA_ORACLE_INSTANCES(long double);

} // namespace clucida::oracle
