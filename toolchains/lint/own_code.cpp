// A plugin of clang-tidy with the check mfar-own. It reports nothing, but limits all other checks to
// declarations outside of system headers. Otherwise, clang-tidy checks the standard library, Eigen
// and OpenCV and discards the results, which takes most of its time.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <vector>

namespace {

class OwnCode : public clang::tidy::ClangTidyCheck {
public:
    using ClangTidyCheck::ClangTidyCheck;

    void registerMatchers(clang::ast_matchers::MatchFinder* finder) override {
        finder->addMatcher(clang::ast_matchers::translationUnitDecl(), this);
    }

    // Runs when clang visits the translation unit, before the declarations in it. So the scope that
    // is set here applies to all these declarations.
    void check(const clang::ast_matchers::MatchFinder::MatchResult& found) override {
        std::vector<clang::Decl*> own;
        // noload: decls() would load all declarations of the precompiled headers.
        for (clang::Decl* declaration : found.Context->getTranslationUnitDecl()->noload_decls()) {
            // Declarations that our files make with macros such as TEST are also kept.
            if (!found.SourceManager->isInSystemHeader(declaration->getLocation())) {
                own.push_back(declaration);
            }
        }
        found.Context->setTraversalScope(own);
    }
};

class OwnModule : public clang::tidy::ClangTidyModule {
public:
    void addCheckFactories(clang::tidy::ClangTidyCheckFactories& factories) override {
        // clang-tidy runs the checks in an order that depends on hashes of their names. With this
        // name, the check runs before readability-identifier-naming, which would otherwise visit
        // all declarations.
        factories.registerCheck<OwnCode>("mfar-own");
    }
};

const clang::tidy::ClangTidyModuleRegistry::Add<OwnModule> kAdded("mfar", "Speed.");

}  // namespace
