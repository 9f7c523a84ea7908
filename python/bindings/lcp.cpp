
#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/lcp/adaptive_bb.hpp"
#include "jostle/lcp/apgd.hpp"
#include "jostle/lcp/bbpgd.hpp"
#include "jostle/lcp/minimum_map_newton.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle::python {

namespace {

/// A matrix in compressed rows: row k has the elements begin[k] ... begin[k + 1] - 1.
class MatrixOfRows final : public LinearOperator {
public:
    MatrixOfRows(std::span<const std::int64_t> begin, std::span<const std::int64_t> column,
                 std::span<const double> element, std::span<const double> diagonal)
        : begin_(begin), column_(column), element_(element), diagonal_(diagonal) {}

    std::size_t size() const override { return diagonal_.size(); }
    std::span<const double> diagonal() const override { return diagonal_; }
    void apply(std::span<const double> x, std::span<double> result) const override {
        parallel_for(size(), [&](std::size_t row) {
            double sum = 0.0;
            for (auto k = static_cast<std::size_t>(begin_[row]); k < static_cast<std::size_t>(begin_[row + 1]); ++k)
                sum += element_[k] * x[static_cast<std::size_t>(column_[k])];
            result[row] = sum;
        });
    }

private:
    std::span<const std::int64_t> begin_, column_;
    std::span<const double> element_, diagonal_;
};

/// A dense matrix, by rows.
class DenseMatrix final : public LinearOperator {
public:
    DenseMatrix(std::span<const double> element, std::span<const double> diagonal)
        : element_(element), diagonal_(diagonal) {}

    std::size_t size() const override { return diagonal_.size(); }
    std::span<const double> diagonal() const override { return diagonal_; }
    void apply(std::span<const double> x, std::span<double> result) const override {
        parallel_for(size(), [&](std::size_t row) {
            double sum = 0.0;
            for (std::size_t k = 0; k < size(); ++k) sum += element_[row * size() + k] * x[k];
            result[row] = sum;
        });
    }

private:
    std::span<const double> element_, diagonal_;
};

/// A matrix known by a Python function x -> A x, which has been made to return a sound array.
class MatrixOfFunction final : public LinearOperator {
public:
    MatrixOfFunction(py::function function, std::span<const double> diagonal)
        : function_(std::move(function)), diagonal_(diagonal) {}

    std::size_t size() const override { return diagonal_.size(); }
    std::span<const double> diagonal() const override { return diagonal_; }
    void apply(std::span<const double> x, std::span<double> result) const override {
        const py::gil_scoped_acquire acquire;
        const auto image = function_(array_of(x)).cast<Numbers>();
        require_shape(image, {static_cast<py::ssize_t>(size())}, "A(x)");
        std::copy_n(image.data(), size(), result.begin());
    }

private:
    py::function function_;
    std::span<const double> diagonal_;
};

using Solver = LcpResult (*)(const LcpProblem&, const LcpSettings&, std::span<const double>);

Solver solver_named(const std::string& method) {
    if (method == "bbpgd") return solve_bbpgd;
    if (method == "adaptive_bb") return solve_adaptive_bb;
    if (method == "apgd") return solve_apgd;
    if (method == "minimum_map_newton") return solve_minimum_map_newton;
    const bool sweeps = method == "projected_sor";
    throw InputError({.key = "method",
                      .value = "\"" + method + "\"",
                      .problem = sweeps ? "works on the velocities of rods, and a matrix has none" : "is unknown",
                      .allowed = "\"adaptive_bb\", \"apgd\", \"bbpgd\", \"minimum_map_newton\"",
                      .suggestion = sweeps ? "Simulation uses it where a scene asks for it" : ""});
}

const char* word_for(LcpStatus status) {
    switch (status) {
        case LcpStatus::converged:
            return "converged";
        case LcpStatus::iteration_limit:
            return "iteration_limit";
        case LcpStatus::infeasible:
            return "infeasible";
        case LcpStatus::not_finite:
            return "not_finite";
        case LcpStatus::interrupted:
            break;
    }
    return "interrupted";
}

/// What every kind of matrix is solved with.
struct Question {
    std::string method;
    Numbers constant, start;
    LcpSettings settings;
    double time_step;
};

Question question(std::string method, Numbers constant, Numbers start, double tolerance, std::uint64_t max_iterations,
                  const std::string& residual, double time_step) {
    LcpSettings settings;
    settings.tolerance = tolerance;
    settings.max_iterations = max_iterations;
    settings.residual = residual == "paper" ? LcpResidual::paper : LcpResidual::length;
    return {std::move(method), std::move(constant), std::move(start), settings, time_step};
}

py::tuple solve(const LinearOperator& matrix, const Question& question) {
    const Solver solver = solver_named(question.method);
    const auto constant = numbers_in(question.constant, "b"), start = numbers_in(question.start, "start");
    LcpResult result;
    {
        const py::gil_scoped_release release;
        result = solver({matrix, constant, question.time_step}, question.settings, start);
    }
    return py::make_tuple(array_of(std::span<const double>(result.solution)),
                          array_of(std::span<const double>(result.velocity)), result.residual, result.iterations,
                          word_for(result.status));
}

}  // namespace

void bind_lcp(py::module_& module) {
    py::class_<Question>(module, "LcpQuestion").def(py::init(&question));
    module.def("solve_dense", [](const Numbers& matrix, const Numbers& diagonal, const Question& question) {
        require_shape(matrix, {diagonal.shape(0), diagonal.shape(0)}, "A");
        const std::span<const double> elements(matrix.data(), static_cast<std::size_t>(matrix.size()));
        return solve(DenseMatrix(elements, numbers_in(diagonal, "diagonal")), question);
    });
    module.def("solve_sparse", [](const Indices& begin, const Indices& column, const Numbers& element,
                                  const Numbers& diagonal, const Question& question) {
        require_shape(begin, {diagonal.shape(0) + 1}, "A.indptr");
        require_shape(column, {element.shape(0)}, "A.indices");
        return solve(MatrixOfRows(indices_in(begin, "A.indptr"), indices_in(column, "A.indices"),
                                  numbers_in(element, "A.data"), numbers_in(diagonal, "diagonal")),
                     question);
    });
    module.def("solve_function", [](py::function function, const Numbers& diagonal, const Question& question) {
        return solve(MatrixOfFunction(std::move(function), numbers_in(diagonal, "diagonal")), question);
    });
}

}  // namespace jostle::python
