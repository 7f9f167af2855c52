#include "bench/ablations.h"
#include "bench/overlay.h"

#include <array>
#include <stdexcept>

// made by kernels/embed.cmake
extern const char* const clucida_stage_unseen_table[];
extern const char* const clucida_stage_unshaded_table[];
extern const char* const clucida_stage_searched_twice_table[];
extern const char* const clucida_stage_confirmed_twice_table[];
extern const char* const clucida_stage_full_twice_table[];
extern const char* const clucida_stage_unhidden_table[];
extern const char* const clucida_stage_full_search_table[];
extern const char* const clucida_stage_counted_table[];
extern const char* const clucida_variant_half_table[];

namespace clucida::bench {

host::FileTexts stage_kernels(const std::string& name)
{
    struct Stage {
        const char* name;
        KernelTable table;
    };
    const std::array stages{Stage{"unseen", clucida_stage_unseen_table},
                            Stage{"unshaded", clucida_stage_unshaded_table},
                            Stage{"searched_twice", clucida_stage_searched_twice_table},
                            Stage{"confirmed_twice", clucida_stage_confirmed_twice_table},
                            Stage{"full_twice", clucida_stage_full_twice_table},
                            Stage{"unhidden", clucida_stage_unhidden_table},
                            Stage{"full_search", clucida_stage_full_search_table},
                            Stage{"counted", clucida_stage_counted_table},
                            Stage{"half", clucida_variant_half_table}};
    for (const Stage& stage : stages)
        if (name == stage.name) return laid_over({stage.table});
    throw std::invalid_argument("there is no stage " + name + " of the kernels");
}

} // namespace clucida::bench
