// zskel batch: many models, one worker process a core, a journal that a later run goes on from.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "batch/gpu_process.h"
#include "batch/gpu_server.h"
#include "batch/machine.h"
#include "batch/manifest.h"
#include "batch/page.h"
#include "batch/plan.h"
#include "batch/run.h"
#include "batch/serve.h"
#include "batch_worker.h"
#include "command.h"
#include "extraction_options.h"
#include "skeleton_output.h"
#include "zskel/core/log.h"
#include "zskel/core/parallel.h"
#include "zskel/io/output_file.h"
#include "zskel/visibility/choose.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::vector<std::string> manifests;
    bool recursive = false;
    SkeletonOutput output{"skeletons/{stem}.json", "", false, false};
    ExtractionOptions how;
    bool strict = false;
    std::string shard = "1/1";
    std::string journal;  // empty: named after the shard
    std::size_t workers = 0;
    double item_timeout_s = 600.0;
    double item_memory_mb = -1.0;  // below 0: a share of what there is
    std::string report;
    bool as_json = false;
    batch::RunOptions run;
};

batch::Task task_of(const Arguments& arguments, const Common& common) {
    batch::Task task;
    task.extract = arguments.how.extract;
    task.backend = arguments.how.backend;
    task.reading = common.reading;
    if (!arguments.output.format.empty() || arguments.output.node_link)
        task.format = format_of(arguments.output);
    task.tubes = arguments.output.tubes;
    task.strict = arguments.strict;
    task.command = common.command;
    return task;
}

std::string journal_of(const Arguments& arguments, const batch::Shard& shard) {
    if (!arguments.journal.empty()) return arguments.journal;
    return shard.count == 1 ? "batch.jsonl"
                            : fmt::format("batch.{}-of-{}.jsonl", shard.number, shard.count);
}

std::vector<batch::Item> plan(const Arguments& arguments, const batch::Shard& shard) {
    std::vector<batch::Entry> entries;
    for (const std::string& manifest : arguments.manifests) {
        for (batch::Entry& entry : batch::read_manifest(manifest, arguments.recursive))
            entries.push_back(std::move(entry));
    }
    if (entries.empty()) {
        throw InputError(
            fmt::format("{}: no model is named", fmt::join(arguments.manifests, ", ")));
    }
    const std::vector<batch::Item> items = batch::plan_items(entries, arguments.output.path);
    for (const batch::Item& item : items) {
        SkeletonOutput output = arguments.output;
        output.path = item.output;
        format_of(output);  // refuses what cannot be written
    }
    batch::check_files(items,
                       {arguments.manifests, journal_of(arguments, shard), arguments.report});
    return batch::items_of_shard(items, shard);
}

// A hundred thousand lines of warnings help nobody: they are in the journal.
void set_worker_log(const Common& common) {
    if (common.verbosity <= 0)
        set_log(LogLevel::Off, common.log_format == "json" ? LogFormat::Json : LogFormat::Text);
}

ExitCode serve_parent(const Arguments& arguments, const Common& common) {
    const WorkerOrders orders = worker_orders();
    set_worker_log(common);
    set_thread_limit(orders.threads);
    batch::Task task = task_of(arguments, common);
    // One context for all, whatever their number: the choice, and with it an item's key, is not to
    // depend on that.
    if (!orders.gpu_address.empty()) task.backend.work.context_share = 0.0;
    if (orders.role == WorkerRole::Gpu)
        batch::serve_gpu(orders.socket, backend_options_for({}, task.extract, task.backend));
    else
        batch::serve(orders.socket, task, orders.gpu_address, orders.memory_mb);
    return ExitCode::Ok;
}

// Opened where a GPU may be used; nothing is loaded there before a worker asks.
std::unique_ptr<batch::GpuProcess> open_gpu_process(const BackendOptions& backend, int threads) {
    if (!uses_gl(backend) && !(backend.kind == BackendKind::Auto && has_gpu_device())) return {};
    return std::make_unique<batch::GpuProcess>([threads](int listening) {
        WorkerOrders orders;
        orders.threads = threads;
        orders.role = WorkerRole::Gpu;
        orders.socket = listening;
        become_worker(orders);
    });
}

void fill_run_options(Arguments& arguments, std::size_t items, const Common& common) {
    const batch::Machine machine = batch::look_at_machine();
    if (arguments.workers == 0) arguments.workers = batch::recommended_workers(machine);
    arguments.workers = std::max(std::min(arguments.workers, items), std::size_t{1});
    if (arguments.item_memory_mb < 0.0) {
        arguments.item_memory_mb =
            static_cast<double>(batch::memory_for_worker(machine, arguments.workers)) / 1e6;
    }
    arguments.run.pool = {arguments.workers, arguments.item_timeout_s};
    if (arguments.report.empty()) arguments.run.thumbnails = 0;
    arguments.run.shows_progress = common.verbosity >= 0 && common.log_format == "text";
}

void write_report(const Arguments& arguments, const std::vector<batch::Item>& items,
                  const batch::Journal& journal, const batch::Tally& tally) {
    if (arguments.report.empty()) return;
    write_output_text(arguments.report, batch::report_page(items, journal, tally));
}

// As the program ends on this signal everywhere else.
[[noreturn]] void end_by(int signal) {
    std::raise(signal);
    ::_exit(128 + signal);
}

ExitCode run_batch(const Arguments& given, const Common& common) {
    check_method_options(given.how);
    check_backend_options(given.how.backend);
    Arguments arguments = given;
    if (is_batch_worker()) return serve_parent(arguments, common);
    const batch::Shard shard = batch::parse_shard(arguments.shard);
    const std::vector<batch::Item> items = plan(arguments, shard);
    check_outputs("-", {arguments.report});
    fill_run_options(arguments, items.size(), common);
    batch::Journal journal(journal_of(arguments, shard));
    if (journal.strange_lines() > 0)
        log_warning("{}: {} lines are no records", journal_of(arguments, shard),
                    journal.strange_lines());
    batch::make_folders(items);
    auto gpu = open_gpu_process(arguments.how.backend, common.threads);
    arguments.run.gpu = gpu.get();
    WorkerOrders orders;
    orders.memory_mb = arguments.item_memory_mb;
    orders.threads = common.threads > 0 || arguments.workers == 1 ? common.threads : 1;
    if (gpu) orders.gpu_address = gpu->address();
    const batch::RunResult result =
        batch::run_items(items, arguments.run, journal, [&orders](int socket) {
            orders.socket = socket;
            become_worker(orders);
        });
    gpu.reset();
    write_report(arguments, items, journal, result.tally);
    print(arguments.as_json ? batch::summary_json(result.tally)
                            : batch::summary_text(result.tally));
    if (!arguments.as_json && result.tally.failed > 0)
        print(fmt::format("which, and why: {}\n", journal_of(arguments, shard)));
    if (result.signal != 0) end_by(result.signal);
    return result.tally.failed > 0 ? ExitCode::Check : ExitCode::Ok;
}

void add_worker_options(CLI::App& command, Arguments& arguments) {
    constexpr const char* kGroup = "Workers";
    command
        .add_option("--workers", arguments.workers,
                    "Processes that work at once, each with one thread unless --threads says "
                    "more [one a core, as far as memory goes: see zskel doctor]")
        ->check(CLI::Range(1, 4096))
        ->group(kGroup);
    command
        .add_option("--item-timeout", arguments.item_timeout_s,
                    "Give an item up after so many seconds; 0: never")
        ->capture_default_str()
        ->check(number_in(0.0, 1e8))
        ->group(kGroup);
    command
        .add_option("--item-memory", arguments.item_memory_mb,
                    "Give an item up when its worker needs more than so many megabytes, of which "
                    "about 300 go to any model; 0: no bound [each worker's share of nine tenths of "
                    "what is free]")
        ->type_name("MB")
        ->check(number_in(0.0, 1e9))
        ->group(kGroup);
}

void add_journal_options(CLI::App& command, Arguments& arguments) {
    command.add_option("--journal", arguments.journal,
                       "A line of JSON for every item; a later run with it goes on where this one "
                       "ends [batch.jsonl; with --shard batch.I-of-N.jsonl]");
    command.add_flag("--retry", arguments.run.retry,
                     "Try what failed before once more; without it only when the model, the "
                     "options, the backend or the version have changed");
    command
        .add_option("--shard", arguments.shard,
                    "Do part I of N, I from 1: every N-th item from the I-th on")
        ->type_name("I/N");
    command.add_option("--report", arguments.report,
                       "Write a page about all items, with thumbnails where GL works (HTML)");
    command
        .add_option("--thumbnails", arguments.run.thumbnails,
                    "Of the first so many items; they are kept in the journal")
        ->capture_default_str()
        ->check(length_or_zero());
    command.add_flag("--json", arguments.as_json, "Print the summary as JSON");
}

constexpr const char* kFooter =
    R"(0 when no item failed, 6 when one did. What has not ended when a signal stops it is as if it had
never begun: the same line goes on.

Examples:
  zskel batch scans/ -o 'out/{stem}.json'
  zskel batch models.csv -o 'out/{group}/{stem}.swc' --item-timeout 60 --report batch.html
  find scans -name '*.stl' | zskel batch - -o 'out/{dir}/{stem}.json'
  zskel batch models.txt --shard 3/8
  cat batch.*-of-8.jsonl > batch.jsonl && zskel batch models.txt)";

}  // namespace

void add_batch_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command =
        app.add_subcommand("batch", "Extract the skeletons of many models, and go on later");
    auto arguments = std::make_shared<Arguments>();
    arguments->run.thumbnails = 500;
    command
        ->add_option("manifest", arguments->manifests,
                     "Folders of models; lists, a path a line (- reads one from standard input); "
                     ".csv with a column model, perhaps output, and others for the template; "
                     ".jsonl: objects with such members; single models")
        ->required();
    command->add_flag("--recursive", arguments->recursive, "Folders within folders too");
    add_output_options(*command, arguments->output);
    command->get_option("--output")
        ->description(
            "Where skeletons go: {stem} the model's name, {name} with its extension, {dir} its "
            "folder, {index} its number from 0, {COLUMN} of the manifest. The extension says the "
            "form, as for zskel extract");
    add_journal_options(*command, *arguments);
    command->add_flag("--strict", arguments->strict,
                      "A skeleton that fails its self-check is a failed item; it is written all "
                      "the same");
    add_worker_options(*command, *arguments);
    add_extraction_options(*command, arguments->how);
    command->footer(kFooter);
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return run_batch(*arguments, common); };
    });
}

}  // namespace zskel::cli
