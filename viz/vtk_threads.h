#pragma once

namespace telestrain::viz {

// How many threads VTK's own loops may work on, in the whole process. Changes no pixel.
void SetVtkThreads(int threads);

}  // namespace telestrain::viz
