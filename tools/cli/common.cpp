#include "command.h"
#include "zskel/io/output_file.h"

namespace zskel::cli {

void add_backend_options(CLI::App& command, BackendOptions& options) {
    command
        .add_option_function<std::string>(
            "--backend",
            [&options](const std::string& name) { options.kind = parse_backend(name); },
            "auto: the first GL context that works, else rays; gl: GL only; egl; osmesa; "
            "ray: Embree; brute: every ray against every triangle")
        ->type_name("NAME");
    command.add_option("--gpu", options.gpu, "Take the hardware device of this number");
    command.add_option("--face-px", options.face_px, "Texels along a cube face, 4 to 1024")
        ->capture_default_str();
    command.add_option(
        "--rays", options.rays,
        "Ray backends: this many directions an eye, spread evenly, in place of the cube's texels "
        "(the paper: 197)");
}

void print(const std::string& text) {
    write_output_text("-", text);
}

}  // namespace zskel::cli
