#include "bench/oracle/instances.h"

namespace clucida::oracle {

CLUCIDA_ORACLE_INSTANCES(Quad);

} // namespace clucida::oracle
