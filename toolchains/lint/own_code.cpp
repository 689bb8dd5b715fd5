// A plugin of clang-tidy: the check mfar-own-code, which says nothing and keeps all the others to
// what is declared outside of system headers. clang-tidy walks through the standard library, Eigen
// and OpenCV with every check and drops what it finds there, which is most of its time.
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

    // The walk reads the scope after it has shown the translation unit itself, the first of all.
    void check(const clang::ast_matchers::MatchFinder::MatchResult& found) override {
        std::vector<clang::Decl*> own;
        for (clang::Decl* declaration : found.Context->getTranslationUnitDecl()->decls()) {
            // Of a macro that is expanded here, too, such as TEST.
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
        factories.registerCheck<OwnCode>("mfar-own-code");
    }
};

const clang::tidy::ClangTidyModuleRegistry::Add<OwnModule> kAdded("mfar", "Speed.");

}  // namespace
