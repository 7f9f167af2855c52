/// The user's wish to stop (SIGINT, SIGTERM), as a question to ask between steps.
#pragma once

namespace clucida::host {

/// From now on the first signal sets a flag; the second ends the program at once. Broken pipes become write errors.
void catch_interrupts();

bool interrupted();

} // namespace clucida::host
