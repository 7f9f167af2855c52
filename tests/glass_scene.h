/// A glass ball on a floor, for tests of what any scene will do for.
#pragma once

namespace clucida::test {

inline constexpr const char* glass_scene = R"(clucida 1
observer { eye [0, -6, 2]; look [0, 0, 0.8]; fov 45 }
sky gradient { low 0.2; middle 0.8; high [0.2, 0.4, 1] }
light { point [5, -5, 8] }
optics glass { reflection 0.1; refraction 0.9; index 1.5 }
optics floor { reflection 0.2; absorption [0.6, 0.5, 0.4] }
object ball { solid sphere([0, 0, 1], 1); optics glass }
object ground { solid plane([0, 0, 0], [0, 0, 1]); optics floor }
)";

} // namespace clucida::test
